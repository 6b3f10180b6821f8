// SPDX-License-Identifier: Apache-2.0
#include "tracking/resting_object.hpp"

#include <Eigen/LU>
#include <cmath>

namespace geoloc {
namespace {

/// The part of an object's sums that comes from the drift nodes of this moment: the last ones.
Landmark::NodeRows recent_drift(const Landmark& landmark, const NodeSpan& now) {
  Landmark::NodeRows sum = Landmark::NodeRows::Zero();
  for (const Landmark::NodeTerms* terms = landmark.end(); terms != landmark.begin();) {
    --terms;
    if (terms->number < now.first) break;
    sum += terms->B;
  }
  return sum;
}

/// What the detector's noise leaves to be known of the object.
PointMatrix pixel_information_of(const LandmarkObservation& observation, const Eigen::Matrix2d& pixel_noise) {
  const Eigen::Matrix<double, 2, kPointSize> H = observation.point_jacobian();
  return H.transpose() * pixel_noise.inverse() * H;
}

/// Position and its derivatives from A x.
void settle(RestingObject& object, const SharedErrorEstimate& errors, const NodeSpan& now) {
  const Landmark& landmark = *object.landmark;
  object.own_covariance = landmark.A().inverse();
  object.pixel_covariance = object.pixel_information.inverse();
  object.sensitivity = errors.whitened<kPointSize>(
      object.own_covariance * landmark.B().leftCols<SharedError::kCalibrationSize>(),
      object.own_covariance * recent_drift(landmark, now));
  object.position_in_enu = object.own_covariance * object.weighted_position;
  object.track.position_in_enu.mean = object.position_in_enu.head<2>();
}

DecisiveLook decisive(const Look& look, const RestingObject& object) {
  return {look.observation, look.pixel_noise + look.frame_noise, look.pixel_noise, look.one_per_image,
          object.track.hits};
}

}  // namespace

void refresh(RestingObject& object, const SharedErrorEstimate& errors, const NodeSpan& now) {
  object.weighted_position = object.landmark->weighted_position(errors.calibration.mean, errors.drift);
  settle(object, errors, now);
}

void clear_sums(RestingObject& object) {
  object.landmark->clear();
  object.landmark->add_prior(object.prior);
  object.pixel_information = object.prior.matrix;
  object.weighted_position = object.prior.vector;
  object.first_look.reset();
  object.height_look.reset();
}

bool has_looks(const RestingObject& object) {
  constexpr double kRounding = 1e-6;  // what looks leave that were taken out; one tells a thousand [1/m^2]
  return (object.pixel_information - object.prior.matrix).trace() > kRounding;
}

void add_look(RestingObject& object, const Look& look, const DriftTimeline& drift) {
  if (!has_looks(object)) object.first_look = decisive(look, object);
  object.landmark->add(look.observation, drift);
  object.pixel_information += pixel_information_of(look.observation, look.pixel_noise);
}

void take_out_look(RestingObject& object, const LandmarkObservation& observation,
                   const Eigen::Matrix2d& pixel_noise, const DriftTimeline& drift) {
  LandmarkObservation opposite = observation;
  opposite.information = -opposite.information;
  object.landmark->add(opposite, drift);
  object.pixel_information -= pixel_information_of(observation, pixel_noise);
}

void add_to_sums(RestingObject& object, const Look& look, const SharedErrorEstimate& errors) {
  constexpr double kMuchLess = 0.25;
  const double height_variance_before = object.own_covariance(2, 2);
  add_look(object, look, errors.drift);
  object.weighted_position += look.observation.weighted_position(errors.calibration.mean, errors.drift);
  settle(object, errors, look.observation.span);
  if (object.own_covariance(2, 2) < kMuchLess * height_variance_before)
    object.height_look = decisive(look, object);
}

void begin_sums(RestingObject& object, const Look& look, const SharedErrorEstimate& errors) {
  clear_sums(object);
  object.mixture = Mixture{};
  object.sums_since = object.last_look;
  add_to_sums(object, look, errors);
  SharedError::PointRow shared = errors.above_home(object.sensitivity);
  // The noise of the look's frame is the object's, while there is no other look.
  constexpr int kOfFrame = SharedError::kSize - SharedError::kFrame;
  shared.topRightCorner<2, kOfFrame>() = look.jacobian.rightCols<kOfFrame>();
  const PointMatrix covariance = object.pixel_covariance + shared * shared.transpose();
  object.track.position_in_enu.covariance = covariance.topLeftCorner<2, 2>();
  object.sigma_height_m = std::sqrt(covariance(2, 2));
}

/// Their C is in the total and cannot be taken out, so that the object is eliminated again: without its
/// elimination it would count as known.
void leave_settled(RestingObject& object, SettledSums& settled) {
  if (object.is_settled) settled.settle(*object.landmark);
  object.is_settled = false;
}

void set_ground(RestingObject& object, const PointInformation& ground) {
  PointInformation change = ground;
  change += -object.ground;
  object.ground = ground;
  add_prior(object, change);
}

void add_prior(RestingObject& object, const PointInformation& prior) {
  object.prior += prior;
  object.landmark->add_prior(prior);
  object.pixel_information += prior.matrix;
  object.weighted_position += prior.vector;
}

void merge_sums(RestingObject& kept, const RestingObject& gone, const DriftTimeline& drift) {
  const PointInformation once_too_often = gone.is_known ? kept.prior : gone.prior;  // that of the ground
  kept.landmark->merge(*gone.landmark, drift);
  kept.landmark->add_prior(-once_too_often);
  kept.pixel_information += gone.pixel_information - once_too_often.matrix;
  kept.is_settled = kept.is_settled || gone.is_settled;
  if (!gone.is_known) return;
  kept.prior = gone.prior;
  kept.ground = gone.ground;
}

}  // namespace geoloc
