// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "geoloc/sim/flight/run_settings.hpp"
#include "geoloc/sim/live/flight_clock.hpp"
#include "geoloc/sim/random.hpp"
#include "geoloc/sim/world/camera_renderer.hpp"

namespace geoloc::sim {

/// The targets of a run, turned at random, among things that look like them, on a ground of the seed's
/// choice.
Scene make_run_scene(const std::vector<Eigen::Vector2d>& targets_in_enu, int distractors, std::uint64_t seed);

/// The true camera on the true flight, live: mount and lens as they are, and pictures older than their
/// stamps. Where the flight is flown X times as fast, latency, jitter and exposure are a X-th, so that they
/// are the same in metres.
class FlightCamera {
 public:
  /// Where the camera is at an exposure, and how far the picture moves during it.
  struct View {
    HostTime exposed_at;
    Rigid3d enu_from_camera;
    Eigen::Vector2d blur_px;
    double zoom;
  };

  /// Flight and clock must outlive it. Throws std::invalid_argument naming every problem of the camera.
  FlightCamera(const Flight& flight, const RunSettings& settings, const FlightClock& clock,
               const Scene& scene);

  /// The view of the picture that will be stamped so; draws its latency.
  View draw_view(HostTime stamp);

  void render(const View& view, cv::Mat& bgr);

 private:
  Rigid3d enu_from_camera(HostTime time) const;

  const Flight& flight_;
  const FlightClock& clock_;
  CameraErrors errors_;
  TrueCamera true_camera_;
  CameraModel model_;
  CameraRenderer renderer_;
  Random timing_;
};

}  // namespace geoloc::sim
