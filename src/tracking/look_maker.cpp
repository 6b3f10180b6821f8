// SPDX-License-Identifier: Apache-2.0
#include "tracking/look_maker.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>

#include "geoloc/geometry/angles.hpp"
#include "geometry/room.hpp"
#include "tracking/ground_prior.hpp"

namespace geoloc {
namespace {

using Index = CalibrationIndex;

/// Share of a lasting noise that the sway does not follow: what it does within a spell. All of it counts at
/// first, while little is known of how long it lasts.
constexpr double kWithinSpell = 0.25;

/// A detector that fires twice on one object: the more confident box came first.
bool is_duplicate(const Look& look, const std::vector<Look>& kept, double duplicate_share) {
  return std::any_of(kept.begin(), kept.end(), [&](const Look& other) {
    return other.detection.class_id == look.detection.class_id &&
           (other.position - look.position).squaredNorm() <
               std::pow(duplicate_share * std::min(other.size_m, look.size_m), 2);
  });
}

Eigen::Matrix2d mean_frame_noise(const std::vector<Look>& looks) {
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (const Look& look : looks) sum += look.frame_noise;
  return looks.empty() ? sum : sum / static_cast<double>(looks.size());
}

/// The calibration that the fix already holds: all but the offset.
CalibrationVector applied(const Calibration& calibration, const FrameView& view) {
  CalibrationVector applied = calibration.mean;
  applied.segment<2>(Index::kOffset).setZero();
  applied[Index::kLatency] = view.latency_s;
  applied[Index::kHeight] = view.lifted_m;
  return applied;
}

/// What the focal length is off by while the camera zooms moves a look to the principal point, or away from
/// it.
Eigen::Matrix2d zoom_noise(const Detection& detection, const GroundFix& fix, const JointFrame& frame) {
  const CameraIntrinsics& camera = frame.projector.camera().intrinsics();
  const Eigen::Vector2d from_principal_px =
      detection.box.centre() - Eigen::Vector2d(camera.cx_px, camera.cy_px);
  const Eigen::Vector2d moved = frame.view.sigma_focal_share * (fix.ground_from_pixel * from_principal_px);
  return moved * moved.transpose();
}

}  // namespace

bool is_of_moving_class(const Detection& detection, const MovingConfig& moving) {
  return std::find(moving.classes.begin(), moving.classes.end(), detection.class_id) != moving.classes.end();
}

double fast_position_variance_m2(const JointTrackerConfig& config, const SharedErrorEstimate& errors) {
  return 0.5 * std::pow(config.fast_share * errors.accuracy.changing_m(), 2);
}

LookMaker::LookMaker(const JointTrackerConfig& config, int max_detections) : config_(config) {
  take_room(this, config, max_detections);
}

std::size_t LookMaker::take_room(LookMaker* self, const JointTrackerConfig& config, int max_detections) {
  FrameLooks* const looks = room::part(self, &LookMaker::looks_);
  const int max_moving = config.moving.classes.empty() ? 0 : max_detections;
  return room::reserve(looks, &FrameLooks::at_rest, max_detections) +
         room::reserve(looks, &FrameLooks::moving, max_moving);
}

FrameLooks& LookMaker::make(const std::vector<LocatedDetection>& detections, const JointFrame& frame,
                            const SharedErrorEstimate& errors) {
  looks_.at_rest.clear();
  looks_.moving.clear();
  const auto is_moving = [&](const LocatedDetection& located) {
    return is_of_moving_class(located.detection, config_.moving);
  };
  looks_.share_attitude =
      static_cast<double>(std::count_if(detections.begin(), detections.end(), std::not_fn(is_moving)));
  for (const LocatedDetection& located : detections) {
    const Look look = make_look(located, looks_.share_attitude, frame, errors);
    std::vector<Look>& kind = is_moving(located) ? looks_.moving : looks_.at_rest;
    if (!is_duplicate(look, kind, config_.duplicate_share)) kind.push_back(look);
  }
  looks_.frame_noise = mean_frame_noise(looks_.at_rest.empty() ? looks_.moving : looks_.at_rest);
  const Eigen::Matrix2d frame_root = looks_.frame_noise.llt().matrixL();
  for (std::vector<Look>* kind : {&looks_.at_rest, &looks_.moving}) {
    for (Look& look : *kind) look.jacobian.middleCols<2>(SharedError::kFrame) = frame_root;
  }
  return looks_;
}

/// Covariances of what a look's position is off by [m^2].
struct LookMaker::Noise {
  Eigen::Matrix2d pixel;
  Eigen::Matrix2d time;
  Eigen::Matrix2d time_of_run;
  Eigen::Matrix2d attitude;
  Eigen::Matrix2d position;
  Eigen::Matrix2d interpolation;  // of the vehicle's state between two samples
  // Not alike for the looks of a frame: of the vehicle's state in a bend, and of a camera that just zooms.
  Eigen::Matrix2d bend;
};

LookMaker::Noise LookMaker::noise_of(const Detection& detection, const GroundFix& fix,
                                     const FixJacobians& jacobians, const JointFrame& frame,
                                     const SharedErrorEstimate& errors) const {
  const VehicleState& vehicle = frame.view.vehicle;
  const CameraTurn& turned = frame.view.turn;
  const auto turn = jacobians.calibration.middleCols<3>(Index::kBoresight);
  const Eigen::Matrix2d per_turn = turn * turn.transpose();
  const Eigen::Vector2d ground_velocity = jacobians.calibration.col(Index::kLatency);
  const Eigen::Matrix2d per_time = ground_velocity * ground_velocity.transpose();
  const double position_variance =
      errors.noise.position_factor() * fast_position_variance_m2(config_, errors);
  return {errors.noise.pixel_factor() * fix.covariance(detection.sigma_px_or(config_.sigma_px)),
          std::pow(config_.sigma_time_s, 2) * per_time,
          std::pow(frame.run_time.sigma_s, 2) * per_time,
          errors.noise.attitude_variance_rad2() * per_turn,
          position_variance * Eigen::Matrix2d::Identity(),
          std::pow(turned.sigma_rad, 2) * per_turn +
              std::pow(vehicle.sigma_position_m, 2) * Eigen::Matrix2d::Identity(),
          std::pow(turned.sigma_bend_rad, 2) * per_turn + zoom_noise(detection, fix, frame)};
}

/// The attitude's error is the same in all looks of a frame: N of them with N times its variance say as much
/// of it as one does, and would be N independent witnesses without. So it is with the stamp's. What the
/// position does within seconds is shared too, but for the most part known from the nodes; it counts once.
/// What the stamps of a run of frames are off by is shared by all looks of all of them.
LandmarkObservation LookMaker::observation(const GroundFix& fix, const FixJacobians& jacobians,
                                           const Noise& noise, double looks_that_share,
                                           const JointFrame& frame, const SharedErrorEstimate& errors) {
  const NoiseRepetition& repetition = frame.repetition;
  const double rest = repetition.lasts() && !errors.is_opening ? kWithinSpell : 1.0;
  LandmarkObservation observation;
  observation.value = fix.position_in_enu - jacobians.calibration * applied(errors.calibration, frame.view);
  observation.slope = -jacobians.height;
  observation.calibration_jacobian = jacobians.calibration;
  observation.node_jacobian = jacobians.node;
  observation.span = frame.span;
  observation.information =
      (noise.pixel + noise.bend + looks_that_share * noise.time +
       frame.run_time.frames * looks_that_share * noise.time_of_run +
       rest * (repetition.of_attitude * looks_that_share * noise.attitude +
               repetition.of_position * noise.position) +
       repetition.of_interpolation * looks_that_share * (noise.interpolation + noise.bend))
          .inverse();
  return observation;
}

/// With o the camera, h its height above the plane and k = h / (h - z), the frame shows an object at (x, z)
/// on the plane at p = o + k (x - o), so that dp = k (dx - s dz) with s the slope of its ray. A turn of the
/// camera, or a pixel, moves the object by as much less than p as it is nearer.
LandmarkObservation LookMaker::linearised_at(const Point& position_in_enu, const Look& look,
                                             double looks_that_share, const JointFrame& frame,
                                             const SharedErrorEstimate& errors) const {
  const FrameShift shift = shift_by(errors.calibration, frame.drift, frame.ground_height_m);
  const Eigen::Vector3d shown_in_enu = shift.shown(Eigen::Vector3d(position_in_enu));
  const auto there = frame.projector.fix_of_point(shown_in_enu, frame.view);
  if (!there) return look.observation;
  const Eigen::Vector3d& camera_in_enu = frame.view.enu_from_camera.translation;
  const double below_camera_m = camera_in_enu.z() - shown_in_enu.z();
  const double k = (camera_in_enu.z() - frame.projector.config().ground_height_above_home_m) / below_camera_m;
  const FixJacobians jacobians = jacobians_of(*there, frame.view, below_camera_m);
  LandmarkObservation expected =
      observation(*there, jacobians, noise_of(look.detection, *there, jacobians, frame, errors),
                  looks_that_share, frame, errors);
  const Eigen::Vector2d from_camera = there->position_in_enu - camera_in_enu.head<2>();
  const Eigen::Vector2d on_plane = camera_in_enu.head<2>() + k * from_camera;
  expected.value += on_plane - there->position_in_enu + (look.fix.position_in_enu - on_plane) / k;
  return expected;
}

Look LookMaker::make_look(const LocatedDetection& located, double looks_that_share, const JointFrame& frame,
                          const SharedErrorEstimate& errors) const {
  const GroundFix& fix = located.fix;
  const Projector& projector = frame.projector;
  const double height_m =
      frame.view.enu_from_camera.translation.z() - projector.config().ground_height_above_home_m;
  const FixJacobians jacobians = jacobians_of(fix, frame.view, height_m);
  const Noise noise = noise_of(located.detection, fix, jacobians, frame, errors);

  Look look;
  look.detection = located.detection;
  look.fix = fix;
  look.pixel_noise = noise.pixel + noise.bend;
  look.frame_noise = noise.attitude + noise.position + noise.interpolation;
  look.observation = observation(fix, jacobians, noise, looks_that_share, frame, errors);
  look.position =
      look.observation.value + jacobians.calibration * errors.calibration.mean + jacobians.node * frame.drift;
  look.camera_height_m = height_m + errors.calibration.height_m() - frame.view.lifted_m;
  place_at_height(look, frame.view.terrain_m);
  look.jacobian =
      errors.whitened<2>(jacobians.calibration.leftCols<SharedError::kCalibrationSize>(), jacobians.node);
  look.jacobian.col(SharedError::kTime) =
      std::hypot(config_.sigma_time_s, frame.run_time.sigma_s) * jacobians.calibration.col(Index::kLatency);
  const CameraIntrinsics& camera = projector.camera().intrinsics();
  const double ground_per_pixel_m2 = std::abs(fix.ground_from_pixel.determinant());
  look.one_per_image = 1.0 / (ground_per_pixel_m2 * camera.width_px * camera.height_px);
  look.clutter_density = frame.clutter_per_frame * look.one_per_image;
  look.ground_per_pixel_m = std::sqrt(ground_per_pixel_m2);
  look.size_m = look.ground_per_pixel_m * std::min(located.detection.box.width, located.detection.box.height);
  return look;
}

}  // namespace geoloc
