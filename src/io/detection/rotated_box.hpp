// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/camera/detection.hpp"

namespace geoloc::io {

/// A box turned about its centre, clockwise in a picture whose y axis points down.
struct RotatedBox {
  double centre_x = 0.0;
  double centre_y = 0.0;
  double width = 0.0;
  double height = 0.0;
  double angle_rad = 0.0;
};

/// The smallest upright box around it.
Box upright_around(const RotatedBox& box);

/// How much two rotated boxes overlap, from 0 to 1: one less the Hellinger distance of the Gaussians with
/// their centres and second moments (Llerena et al. 2021, "Gaussian Bounding Boxes and Probabilistic
/// Intersection-over-Union for Object Detection"). Networks for rotated boxes are trained and tuned with it.
double probabilistic_overlap(const RotatedBox& a, const RotatedBox& b);

}  // namespace geoloc::io
