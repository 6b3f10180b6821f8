// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/attitude.hpp"
#include "geoloc/projection/projector.hpp"

namespace geoloc {

inline const CameraIntrinsics kCamera{
    1280, 720, 914.0, 914.0, 639.5, 359.5, {-0.1, 0.03, 0.001, -0.001, 0.0}};

struct Regime {
  const char* name;
  double height_m;
  double pitch_deg;  ///< of the camera
  double roll_deg;
  double yaw_deg;
};

inline Rigid3d pose_of(const Regime& regime) {
  CameraMount mount;
  mount.pitch_deg = regime.pitch_deg;
  const EulerAngles vehicle{regime.roll_deg * kRadPerDeg, 0.02, regime.yaw_deg * kRadPerDeg};
  return Rigid3d{enu_from_ned() * ned_from_body(vehicle), {12.0, -7.0, regime.height_m}} *
         body_from_camera(mount);
}

inline ProjectorConfig ground_at_1_5_m() {
  ProjectorConfig config;
  config.ground_height_above_home_m = 1.5;
  config.max_range_m = 5000.0;
  return config;
}

inline auto every_regime() {
  return ::testing::Values(Regime{"nadir", 20, -90, 0, 30}, Regime{"banked", 20, -90, 25, 200},
                           Regime{"oblique", 60, -45, -10, 300}, Regime{"grazing", 80, -20, 2, 95});
}

inline std::string regime_name(const ::testing::TestParamInfo<Regime>& regime) {
  return regime.param.name;
}

}  // namespace geoloc
