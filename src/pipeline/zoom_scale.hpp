// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "geoloc/camera/camera.hpp"
#include "geoloc/state/samples.hpp"

namespace geoloc {

/// Focal lengths of a camera that zooms, by the fields of view that it tells and by its calibration. Fields
/// of view are nominal, to some percent, and the calibration knows better: where the camera stands still at
/// one that is the calibration's but for such an error, that error is taken out of all.
class ZoomScale {
 public:
  explicit ZoomScale(const CameraIntrinsics& calibration) : calibration_(calibration) {}

  /// [fx, fy]; nullopt where the sample tells none that the camera may have.
  std::optional<Eigen::Vector2d> focal_px(const FieldOfViewSample& sample);

 private:
  CameraIntrinsics calibration_;
  std::optional<double> last_zoom_;
  std::optional<double> zoom_at_calibration_;  // as it is told
};

}  // namespace geoloc
