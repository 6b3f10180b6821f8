// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "geoloc/camera/camera.hpp"
#include "geoloc/geometry/time.hpp"

namespace geoloc {

/// Axis-aligned box in pixels of the full image, in continuous coordinates: the image's left edge is x = 0.
struct Box {
  double x = 0.0;  ///< left edge
  double y = 0.0;  ///< top edge
  double width = 0.0;
  double height = 0.0;

  /// Centre in the camera model's coordinates, where integers are pixel centres (OpenCV's K): half a pixel
  /// less.
  Eigen::Vector2d centre() const { return {x + 0.5 * width - 0.5, y + 0.5 * height - 0.5}; }
};

struct Detection {
  Box box;
  double confidence = 0.0;  ///< 0..1
  int class_id = 0;
  /// 1-sigma of the box's centre per axis; 0: not stated, and the configured constant holds.
  double sigma_px = 0.0;

  double sigma_px_or(double constant_px) const { return sigma_px > 0.0 ? sigma_px : constant_px; }
};

inline constexpr double kSmallestSigma_px = 1e-3;
inline constexpr double kLargestSigma_px = 1e3;

/// Whether it can be a Detection's that is stated. False for NaN.
inline bool is_sigma_px(double sigma_px) {
  return sigma_px >= kSmallestSigma_px && sigma_px <= kLargestSigma_px;
}

/// A frame whose time is less certain than that has none.
inline constexpr double kLargestTimeSigma_s = 60.0;

/// What a detector saw in one frame. An empty list is information too: nothing was seen.
struct FrameDetections {
  VehicleTime captured_at;  ///< middle of the exposure, on the autopilot's clock
  /// The same instant as UTC, on a clock that never steps: how long objects were seen for, and whether the
  /// autopilot's clock steps, is told by it. Where it is left at zero, captured_at stands for it.
  HostTime captured_at_host;
  std::vector<Detection> detections;
  /// 1-sigma of captured_at, but for what is constant over the flight; 0: not stated, and the configured
  /// constant holds.
  double time_sigma_s = 0.0;
  /// How a camera on a gimbal was mounted at captured_at; nullopt: as configured.
  std::optional<CameraMount> mount = std::nullopt;
  /// Focal length [fx, fy] of a camera that zooms, in px of the full image; nullopt: the calibration's. Its
  /// principal point and its distortion stay the calibration's.
  std::optional<Eigen::Vector2d> focal_px = std::nullopt;
};

}  // namespace geoloc
