// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "geoloc/camera/camera.hpp"

namespace geoloc {

/// What the fields of view that cameras tell are off by at most, as a share: they are nominal. One that is
/// farther from the calibration's is another zoom, or of another camera.
inline constexpr double kMostViewError = 0.05;

/// The angle of view from edge to edge [rad] of so many pixels, by a lens without distortion.
double angle_of_view_rad(int size_px, double focal_px);

/// How many times longer the focal length of a camera that sees so much from edge to edge [rad] is than the
/// calibration's. The horizontal angle counts where it is told; nullopt where none is an angle of a lens.
std::optional<double> zoom_of_view(const std::optional<double>& horizontal_rad,
                                   const std::optional<double>& vertical_rad,
                                   const CameraIntrinsics& calibration);

}  // namespace geoloc
