// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "calibration/arrowhead.hpp"
#include "support/nadir_flight.hpp"
#include "tracking/calibrated_viewer.hpp"

namespace geoloc::testing {

/// A vehicle over objects whose camera, boresight and height are known, but not when its frames were taken.
/// All pixels are written out in closed form.
struct WatchedFlight {
  explicit WatchedFlight(Path flown) : path(std::move(flown)) {
    errors.calibration.mean.setZero();
    errors.calibration.covariance.setZero();
    fly_until(0.0);
  }

  /// The vehicle's reports up to then, and half a second on.
  void fly_until(double time_s) {
    for (; 0.1 * samples < time_s + 0.5; ++samples) {
      const double sample_s = 0.1 * samples;
      const Pose pose = path(sample_s);
      state.add(position_sample(sample_s, pose));
      state.add(attitude_sample(sample_s, pose));
    }
  }

  /// What a frame shows that was taken then.
  std::vector<LocatedDetection> boxes(double exposed_s, const std::vector<Eigen::Vector2d>& places) const {
    std::vector<LocatedDetection> boxes;
    for (const Eigen::Vector2d& place : places) {
      const auto pixel = pixel_of(place, path(exposed_s));
      if (!pixel || pixel->x() < 20 || pixel->x() > kImageWidth_px - 20 || pixel->y() < 20 ||
          pixel->y() > kImageHeight_px - 20)
        continue;
      boxes.push_back({box_at(*pixel), {}});
    }
    return boxes;
  }

  static FrameStamp stamp(double stamp_s) { return {at_s(stamp_s), host_at_s(stamp_s)}; }

  CalibratedViewer viewer(bool is_void = false) const {
    return {frame_viewer, projector, errors, is_void, 0.0};
  }

  Path path;
  int samples = 0;
  StateProvider state{StateConfig{}};
  CameraMount mount;
  FrameViewer frame_viewer{state, mount, CameraOrientation::kComposed};
  Projector projector{ProjectorConfig{}, CameraIntrinsics{}};
  ArrowheadSolver solver{CalibrationPrior{}, DriftConfig{}};
  SharedErrorEstimate errors{PositionAccuracy{0.5, 0.2, 0.1, 0.1}, HeightPrior{0.0, 1.0},
                             NoiseEstimate(0.005), DriftConfig{}, solver};
};

/// To the north, level and at 5 m/s: there is no turning that would tell of a latency.
inline Pose straight_on(double time_s) {
  return {{0.0, 5.0 * time_s, 20.0}, 0.0, 0.0, 0.0};
}

}  // namespace geoloc::testing
