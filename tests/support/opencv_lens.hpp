// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/camera/camera.hpp"
#include "support/number_lines.hpp"

namespace geoloc {

/// The camera that a line `lens NAME fx fy cx cy k1 k2 p1 p2 k3` of tests/data/camera describes.
inline CameraIntrinsics intrinsics_of(const NumberLine& lens) {
  const std::vector<double>& n = lens.numbers;
  return {1280, 720, n.at(0), n.at(1), n.at(2), n.at(3), {n.at(4), n.at(5), n.at(6), n.at(7), n.at(8)}};
}

}  // namespace geoloc
