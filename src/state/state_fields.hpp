// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/state/vehicle_state.hpp"
#include "settings/rules.hpp"

namespace geoloc {

template <>
struct EnumNames<AttitudeInterpolation> {
  static constexpr std::array<std::pair<AttitudeInterpolation, const char*>, 2> all{
      {{AttitudeInterpolation::kCircular, "circular"}, {AttitudeInterpolation::kSlerp, "slerp"}}};
};

template <>
struct EnumNames<GimbalYawReading> {
  static constexpr std::array<std::pair<GimbalYawReading, const char*>, 3> all{
      {{GimbalYawReading::kAsTold, "told"},
       {GimbalYawReading::kFromNose, "nose"},
       {GimbalYawReading::kFromNorth, "north"}}};
};

template <class Visitor>
void visit_fields(Visitor& v, StateConfig& state) {
  v.field("attitude_interpolation", state.attitude_interpolation, Any{}, "",
          "The shortest rotation (slerp), or each angle by itself (circular) as in the paper's eq. 5");
  v.field("max_gap_s", state.max_gap_s, Range::above(0, 60), "s",
          "A longer hole in the telemetry gives no state, but for 0.2 s about each sample");
  v.field("max_extrapolation_s", state.max_extrapolation_s, Range::closed(0, 0.1), "s",
          "How far beyond the newest sample a state is given");
  v.field("gimbal_yaw", state.gimbal_yaw, Any{}, "",
          "What a gimbal's yaw counts from: what its flags say, until the vehicle's turns contradict them "
          "(told); the vehicle's nose; north");
}

}  // namespace geoloc
