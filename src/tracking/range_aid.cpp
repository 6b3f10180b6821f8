// SPDX-License-Identifier: Apache-2.0
#include "tracking/range_aid.hpp"

#include <algorithm>
#include <cmath>

namespace geoloc {
namespace {

/// Noise of a reading: laser and sonar sensors state centimetres, and their scale to a few percent.
constexpr double kSigma_m = 0.1, kSigmaShare = 0.03;
/// A beam that leaves so obliquely (cosine of 37 deg) comes from an aerobatic vehicle, or meets a wall.
constexpr double kLeastCosine = 0.8;
/// Lower, nobody searches: the beam meets a landing gear.
constexpr double kLowestFlight_m = 2.0;
constexpr double kGate = 16.0;  // squared, 1 degree of freedom
/// While the height's variance is more than this share of its prior's, looks have not told of it.
constexpr double kUntold = 0.5;

}  // namespace

std::optional<HeightReading> height_reading(double distance_m, const VehicleState& vehicle,
                                            double level_above_home_m, const GroundModel& ground) {
  const Eigen::Vector3d beam = distance_m * (vehicle.enu_from_body.rotation * Eigen::Vector3d::UnitZ());
  const double height_m = -beam.z();  // above where the beam ends
  if (!(height_m >= kLeastCosine * distance_m) || !(height_m >= kLowestFlight_m)) return std::nullopt;
  const Eigen::Vector3d& reported = vehicle.enu_from_body.translation;
  const GroundAt below = ground.at(reported.head<2>() + beam.head<2>());
  const double noise_m = std::hypot(kSigma_m, kSigmaShare * distance_m);
  return HeightReading{below.height_m + height_m - (reported.z() - level_above_home_m),
                       noise_m * noise_m + below.sigma_m * below.sigma_m};
}

bool agrees(const HeightReading& reading, const SharedErrorEstimate& errors, const NodeSpan& now) {
  constexpr int kHeight = CalibrationIndex::kHeight;
  const double height_m = errors.calibration.height_m();
  const double known = errors.calibration.covariance(kHeight, kHeight);
  if (known > kUntold * std::pow(errors.height_prior.sigma_at(height_m), 2)) return true;
  const double expected_m = height_m + errors.drift.at(now)[kNodeUp];
  const double variance = reading.variance_m2 + known + errors.drift_root.row(kNodeUp).squaredNorm();
  return std::pow(reading.value_m - expected_m, 2) <= kGate * variance;
}

}  // namespace geoloc
