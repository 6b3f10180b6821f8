// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/camera/camera.hpp"
#include "geoloc/io/recording/recording.hpp"
#include "geoloc/sim/flight/flight.hpp"

namespace geoloc::sim {

/// How the real camera differs from what the estimator is told about it.
struct CameraErrors {
  double latency_s = 0.12;         ///< [s] a frame's stamp is later than its exposure by this
  double latency_jitter_s = 0.01;  ///< [s] 1-sigma of the same, drawn for each frame
  double mount_sigma_deg =
      0.7;  ///< [deg] 1-sigma of the mounting error about each body axis, drawn for each run
  std::optional<std::array<double, 3>>
      mount_error_deg;             ///< [deg] about forward, right, down: instead of a drawn one
  bool lens_is_calibrated = true;  ///< the estimator is told the lens distortion
  double focal_percent = 0.0;      ///< the true focal length is so much longer than the estimator is told
  double clock_step_s = 0.0;       ///< [s] the camera's clock is ahead by so much from the run's middle on
  double late_start_s = 0.0;       ///< [s] stamps of the first kStreamStart_s are later by so much
};

/// For so long after connecting, a stream's sender is not known to tell the time [s].
inline constexpr double kStreamStart_s = 2.5;

/// What a recording and a live run have in common.
struct RunSettings {
  int scenario = 1;                       ///< 1 spread, 2 tight clusters, 3 grid
  std::optional<double> pair_distance_m;  ///< in place of the scenario: targets in pairs so far apart
  std::uint64_t seed = 1;                 ///< other seeds give other targets and other errors
  double frame_rate_hz = 10.0;            ///< [Hz]
  CameraConfig camera;                    ///< as it is meant to be; its distortion is the true lens
  CameraErrors errors;
  std::optional<double> start_s;  ///< [s] on the vehicle's clock; unset: when the survey height is reached
  std::optional<double> end_s;    ///< [s] on the vehicle's clock; unset: when the survey height is left

  /// Every fault, named by its JSON path.
  std::vector<std::string> problems() const;
};

/// The camera as it is.
struct TrueCamera {
  CameraIntrinsics intrinsics;
  Rigid3d carrier_from_camera;      ///< of the body, or the gimbal
  Eigen::Vector3d mount_error_deg;  ///< turn about the carrier's forward, right and down axes
};

/// Runs of one seed over different flights and scenarios share their targets but not their errors.
std::uint64_t run_seed(const RunSettings& settings, const Flight& flight);

TrueCamera make_true_camera(const RunSettings& settings, std::uint64_t run_seed);

/// A camera whose focal length is so many times as long.
CameraModel zoomed(const CameraModel& camera, double zoom);

/// The camera as the estimator is told.
CameraConfig nominal_camera(const RunSettings& settings);

/// The part of the flight that the run shows. Throws std::invalid_argument where it holds no truth.
TimeSpan run_span(const RunSettings& settings, const Trajectory& truth);

/// Where the run's targets stand, east and north of home [m].
std::vector<Eigen::Vector2d> make_targets(const RunSettings& settings);

/// The targets as they stand in truth files: ids from 0, class 0. Up is the height above home.
std::vector<io::TrueTarget> true_targets(const std::vector<Eigen::Vector3d>& positions_in_enu,
                                         const LocalFrame& frame);

}  // namespace geoloc::sim
