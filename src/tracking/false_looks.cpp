// SPDX-License-Identifier: Apache-2.0
#include "tracking/false_looks.hpp"

#include <Eigen/LU>
#include <utility>

#include "tracking/gaussian.hpp"

namespace geoloc {
namespace {

/// Looks from which on the others outvote one, and those after it in which they do.
constexpr int kLeastHits = 4, kHitsToTell = 60;
/// What a camera sees moves alike within this share of its height.
constexpr double kNear = 0.1;
/// So few looks are better begun anew than kept with a false one.
constexpr int kFewHits = 16;

/// Whether the sums still hold the look as it was added.
bool can_be_taken_out(const DecisiveLook& look, const DriftTimeline& drift) {
  return look.observation.span.first >= drift.begin_of_fine();
}

/// Covariance of a look's residual: its own noise, and what the shared errors make of look and object.
Eigen::Matrix2d residual_covariance(const LandmarkObservation& observation, const Eigen::Matrix2d& noise,
                                    const PointMatrix& own, const RestingObject& object,
                                    const SharedErrorEstimate& errors) {
  const Eigen::Matrix<double, 2, kPointSize> H = observation.point_jacobian();
  const SharedError::Row shared =
      errors.whitened<2>(observation.calibration_jacobian.leftCols<SharedError::kCalibrationSize>(),
                         observation.node_jacobian) -
      H * object.sensitivity;
  return noise + H * own * H.transpose() + squared(shared);
}

/// Density of the look where the object's other looks are right [1/m^2].
double density_by_others(const DecisiveLook& look, const RestingObject& object,
                         const SharedErrorEstimate& errors) {
  const LandmarkObservation& observation = look.observation;
  const CalibrationVector& calibration = errors.calibration.mean;
  const Eigen::Matrix<double, 2, kPointSize> H = observation.point_jacobian();
  const PointMatrix own =
      PointMatrix(object.landmark->A() - H.transpose() * observation.information * H).inverse();
  const Point position =
      own * (object.weighted_position - observation.weighted_position(calibration, errors.drift));
  return density(observation.seen(calibration, errors.drift) - H * position,
                 residual_covariance(observation, look.noise, own, object, errors));
}

bool is_false(const std::optional<DecisiveLook>& look, double odds, const RestingObject& object,
              const SharedErrorEstimate& errors) {
  if (!look || object.track.hits < kLeastHits || object.track.hits > look->hits + kHitsToTell) return false;
  if (!can_be_taken_out(*look, errors.drift) && object.track.hits > kFewHits) return false;
  return density_by_others(*look, object, errors) < odds * look->one_per_image;
}

}  // namespace

bool is_far(const Look& look, const JointAssociation::Match& match) {
  return match.innovation.norm() > kNear * look.camera_height_m;
}

bool agrees(const LandmarkObservation& observation, const RestingObject& object, double gate,
            const SharedErrorEstimate& errors) {
  const Eigen::Vector2d residual = observation.seen(errors.calibration.mean, errors.drift) -
                                   observation.point_jacobian() * object.position_in_enu;
  const Eigen::Matrix2d covariance = residual_covariance(observation, observation.information.inverse(),
                                                         object.own_covariance, object, errors);
  return mahalanobis_squared(residual, covariance) < gate;
}

std::optional<DecisiveLook> drop_false_looks(RestingObject& object, const Look& newest, const FalseOdds& odds,
                                             const SharedErrorEstimate& errors) {
  const bool is_height_false = is_false(object.height_look, odds.of_later, object, errors);
  const bool is_first_false = !is_height_false && is_false(object.first_look, odds.of_first, object, errors);
  if (!is_height_false && !is_first_false) return std::nullopt;
  const auto look = std::exchange(is_first_false ? object.first_look : object.height_look, std::nullopt);
  --object.track.hits;
  if (!can_be_taken_out(*look, errors.drift)) {
    begin_sums(object, newest, errors);
    return look;
  }
  take_out_look(object, look->observation, look->pixel_noise, errors.drift);
  if (is_first_false) object.sums_since += Duration{1};
  refresh(object, errors, newest.observation.span);
  return look;
}

}  // namespace geoloc
