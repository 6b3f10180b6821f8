// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "geoloc/projection/projector.hpp"

namespace geoloc {

/// East and north of all that a frame may show in the projector's plane, and of what stands up to `up_m`
/// above or below it: a box around where the image's border meets it. Where the border is above the horizon,
/// the plane ends as far away as fixes do.
Eigen::AlignedBox2d footprint(const Projector& projector, const FrameView& view, double up_m);

}  // namespace geoloc
