// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/tracking/joint_tracker.hpp"

// What a frame's detections say, as looks.
namespace geoloc {
namespace {

using Index = CalibrationIndex;

/// A detector that fires twice on one object: the more confident box came first.
bool is_duplicate(const Look& look, const std::vector<Look>& kept, double duplicate_share) {
  return std::any_of(kept.begin(), kept.end(), [&](const Look& other) {
    return other.detection->class_id == look.detection->class_id &&
           (other.position - look.position).squaredNorm() <
               std::pow(duplicate_share * std::min(other.size_m, look.size_m), 2);
  });
}

Eigen::Matrix2d mean_frame_noise(const std::vector<Look>& looks) {
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (const Look& look : looks) sum += look.frame_noise;
  return looks.empty() ? sum : sum / static_cast<double>(looks.size());
}

}  // namespace

void JointTracker::make_looks(const std::vector<LocatedDetection>& detections, const Projector& projector,
                              const FrameView& view) {
  looks_.clear();
  moving_looks_.clear();
  const auto is_moving = [&](const LocatedDetection& located) {
    return moving_.is_of_moving_class(located.detection);
  };
  const auto at_rest = static_cast<double>(std::count_if(
      detections.begin(), detections.end(), [&](const LocatedDetection& one) { return !is_moving(one); }));
  for (const LocatedDetection& located : detections) {
    const Look look = make_look(located, at_rest, projector, view);
    std::vector<Look>& kind = is_moving(located) ? moving_looks_ : looks_;
    if (!is_duplicate(look, kind, config_.duplicate_share)) kind.push_back(look);
  }
  frame_noise_ = mean_frame_noise(looks_.empty() ? moving_looks_ : looks_);
  const Eigen::Matrix2d frame_root = frame_noise_.llt().matrixL();
  for (std::vector<Look>* kind : {&looks_, &moving_looks_}) {
    for (Look& look : *kind) look.jacobian.middleCols<2>(SharedError::kFrame) = frame_root;
  }
}

/// The attitude's error is the same in all looks of a frame: N of them with N times its variance say as much
/// of it as one does, and would be N independent witnesses without. What the position does within seconds is
/// shared too, but for the most part known from the nodes; it counts once.
Look JointTracker::make_look(const LocatedDetection& located, double looks_that_share,
                             const Projector& projector, const FrameView& view) const {
  const double height_m =
      view.enu_from_camera.translation.z() - projector.config().ground_height_above_home_m;
  const FixJacobians jacobians = jacobians_of(located.fix, view, height_m);
  const auto turn = jacobians.calibration.middleCols<3>(Index::kBoresight);
  const Eigen::Vector2d ground_velocity = jacobians.calibration.col(Index::kLatency);
  const Eigen::Matrix2d time_noise =
      std::pow(config_.sigma_time_s, 2) * ground_velocity * ground_velocity.transpose();
  const Eigen::Matrix2d attitude_noise =
      std::pow(config_.sigma_attitude_deg * kRadPerDeg, 2) * turn * turn.transpose();
  const Eigen::Matrix2d position_noise =
      std::pow(config_.fast_share * drift_.position_scale() * reported_accuracy_m_, 2) / 2.0 *
      Eigen::Matrix2d::Identity();
  // What the fix already holds: all but the offset.
  CalibrationVector applied = calibration_.mean;
  applied.segment<2>(Index::kOffset).setZero();

  Look look;
  look.pixel_noise = located.fix.covariance(located.detection.sigma_px_or(config_.sigma_px));
  look.frame_noise = attitude_noise + position_noise;
  look.observation.value = located.fix.position_in_enu - jacobians.calibration * applied;
  look.observation.calibration_jacobian = jacobians.calibration;
  look.observation.node_jacobian = jacobians.node;
  look.observation.span = span_;
  look.observation.information =
      (look.pixel_noise + time_noise + attitude_correlation_ * looks_that_share * attitude_noise +
       noise_correlation_ * position_noise)
          .inverse();
  look.position = located.fix.position_in_enu + calibration_.offset_m() + jacobians.node * drift_now_;
  look.jacobian = whitened(jacobians.calibration.leftCols<SharedError::kCalibrationSize>(), jacobians.node);
  look.jacobian.col(SharedError::kTime) = config_.sigma_time_s * ground_velocity;
  const CameraIntrinsics& camera = projector.camera().intrinsics();
  const double ground_per_pixel_m2 = std::abs(located.fix.ground_from_pixel.determinant());
  look.clutter_density =
      config_.clutter_per_frame / (ground_per_pixel_m2 * camera.width_px * camera.height_px);
  look.ground_per_pixel_m = std::sqrt(ground_per_pixel_m2);
  look.size_m = look.ground_per_pixel_m * std::min(located.detection.box.width, located.detection.box.height);
  look.detection = &located.detection;
  return look;
}

}  // namespace geoloc
