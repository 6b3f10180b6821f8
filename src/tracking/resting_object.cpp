// SPDX-License-Identifier: Apache-2.0
#include "tracking/resting_object.hpp"

#include <Eigen/LU>

namespace geoloc {
namespace {

/// The part of an object's sums that comes from the drift nodes of this moment.
Eigen::Matrix<double, 2, kNodeSize> recent_drift(const Landmark& landmark, const NodeSpan& now) {
  Eigen::Matrix<double, 2, kNodeSize> sum = Eigen::Matrix<double, 2, kNodeSize>::Zero();
  for (const Landmark::NodeTerms& terms : landmark) {
    if (terms.number >= now.first) sum += terms.B;
  }
  return sum;
}

}  // namespace

void refresh(RestingObject& object, const SharedErrorEstimate& errors, const NodeSpan& now) {
  const Landmark& landmark = *object.landmark;
  object.own_covariance = landmark.A().inverse();
  object.sensitivity =
      errors.whitened(object.own_covariance * landmark.B().leftCols<SharedError::kCalibrationSize>(),
                      object.own_covariance * recent_drift(landmark, now));
  object.track.position_in_enu.mean = landmark.position(errors.calibration.mean, errors.drift);
}

void add_to_sums(RestingObject& object, const Look& look, const SharedErrorEstimate& errors) {
  object.landmark->add(look.observation, errors.drift);
  object.pixel_information += look.pixel_noise.inverse();
  refresh(object, errors, look.observation.span);
}

void begin_sums(RestingObject& object, const Look& look, const SharedErrorEstimate& errors) {
  *object.landmark = Landmark{};
  object.pixel_information.setZero();
  object.mixture = Mixture{};
  add_to_sums(object, look, errors);
  object.track.position_in_enu.covariance = look.pixel_noise + look.jacobian * look.jacobian.transpose();
}

}  // namespace geoloc
