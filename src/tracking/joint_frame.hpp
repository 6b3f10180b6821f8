// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "calibration/drift.hpp"
#include "geoloc/calibration/calibration.hpp"
#include "geoloc/geometry/time.hpp"
#include "tracking/stream_start.hpp"
#include "tracking/tracker.hpp"

namespace geoloc {

/// Over how many frames the noise of one lasts: by which the variance of a mean over many frames is larger
/// than if their noise was independent.
struct NoiseRepetition {
  double of_position = 1.0;
  double of_attitude = 1.0;
  double of_interpolation = 1.0;

  /// Whether frames come so fast that the attitude's noise lasts from one to the next.
  bool lasts() const { return of_attitude > 1.0; }
};

/// Tells how long the noise of one frame lasts, in frames of the present rate.
class NoiseClock {
 public:
  NoiseClock(double position_time_constant_s, double attitude_time_constant_s)
      : position_time_constant_s_(position_time_constant_s),
        attitude_time_constant_s_(attitude_time_constant_s) {}

  /// Frames in order of their time; where one is no later than the one before, the rate stands.
  /// telemetry_gap: between the samples that the frame's state was interpolated from.
  NoiseRepetition tick(VehicleTime now, Duration telemetry_gap = Duration::zero()) {
    const double pause_s = last_ ? seconds(now - *last_) : 0.0;
    if (pause_s > 0.0) pause_s_ = pause_s;
    last_ = now;
    return {frames_in(2.0 * position_time_constant_s_), frames_in(2.0 * attitude_time_constant_s_),
            frames_in(seconds(telemetry_gap))};
  }

 private:
  double position_time_constant_s_;
  double attitude_time_constant_s_;
  double frames_in(double time_s) const { return std::max(1.0, time_s / pause_s_); }

  std::optional<VehicleTime> last_;
  double pause_s_ = std::numeric_limits<double>::infinity();  // between the last frames
};

/// The present frame as the joint method sees it.
struct JointFrame {
  const Projector& projector;
  const FrameView& view;
  NodeSpan span;     ///< drift nodes around the frame's time
  NodeVector drift;  ///< estimate at that time
  NoiseRepetition repetition;
  double ground_height_m;    ///< of the level ground above home, in the lifted view, before the calibration
  double clutter_per_frame;  ///< false boxes
  RunTimeError run_time = {};

  VehicleTime time() const { return view.vehicle.time; }

  /// The same frame, were that its view.
  JointFrame seen_from(const FrameView& other) const {
    return {projector, other, span, drift, repetition, ground_height_m, clutter_per_frame, run_time};
  }
};

/// How far places stand from where the present frame shows them.
struct FrameShift {
  Eigen::Vector2d offset;  ///< constant error of the vehicle's position [m]
  Eigen::Vector2d drift;   ///< of it, what wanders [m]
  Eigen::Vector2d common;  ///< median of the frame's looks minus their tracks [m]
  double level_m;          ///< height of the level ground in the frame's view

  /// Where the frame shows a place: corrections undone.
  Eigen::Vector2d shown(const Eigen::Vector2d& position_in_enu) const {
    return position_in_enu - offset - drift + common;
  }

  Eigen::Vector3d shown(Eigen::Vector3d point_in_enu) const {
    point_in_enu.head<2>() = shown(Eigen::Vector2d(point_in_enu.head<2>()));
    point_in_enu.z() += level_m;
    return point_in_enu;
  }

  /// The frame shows a place at itself minus this [m].
  Eigen::Vector2d correction() const { return offset + drift - common; }
};

/// By what is known of the vehicle's position by now. ground_height_m: of the level ground above home, in the
/// frame's lifted view, before the calibration.
inline FrameShift shift_by(const Calibration& calibration, const NodeVector& drift, double ground_height_m,
                           const Eigen::Vector2d& common = Eigen::Vector2d::Zero()) {
  return {calibration.offset_m(), drift.head<2>(), common, ground_height_m - calibration.height_m()};
}

/// Noise that all looks of a frame share, and that the frames about it share in part.
struct FrameNoise {
  Eigen::Matrix2d covariance;  ///< of attitude and position [m^2]
  double repetition;           ///< frames that share it
  double time_constant_s;

  /// Share that the frames' common noise leaves in a track of so many hits: all of it, until the track was
  /// seen for longer than the noise lasts.
  double share_in_track(int hits) const { return std::min(1.0, repetition / hits); }

  /// Share of it that two moments have in common.
  double common_share(Duration apart) const {
    return std::exp(-std::abs(seconds(apart)) / std::max(time_constant_s, 1e-3));
  }
};

}  // namespace geoloc
