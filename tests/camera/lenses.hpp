// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include "geoloc/camera/camera.hpp"

namespace geoloc {

struct Lens {
  const char* name;
  std::array<double, 5> distortion;
};

inline CameraIntrinsics camera_with(const std::array<double, 5>& distortion) {
  return {1280, 720, 905.3, 911.7, 631.2, 366.4, distortion};
}

inline auto every_lens() {
  return ::testing::Values(Lens{"pinhole", {}}, Lens{"barrel", {-0.28, 0.09, 0.001, -0.0005, -0.01}},
                           Lens{"pincushion", {0.12, -0.02, -0.002, 0.001, 0.0}});
}

inline std::string lens_name(const ::testing::TestParamInfo<Lens>& lens) {
  return lens.param.name;
}

}  // namespace geoloc
