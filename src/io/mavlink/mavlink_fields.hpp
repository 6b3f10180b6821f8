// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/io/mavlink/mavlink_config.hpp"
#include "settings/rules.hpp"

namespace geoloc::io {

template <class Visitor>
void visit_fields(Visitor& v, MavlinkConfig& mavlink) {
  constexpr Range kRate = Range::closed(1, 50);
  v.field("system_id", mavlink.system_id, Range::closed(0, 255), "",
          "MAVLink system of the vehicle; 0: the autopilot that sends its attitude and position");
  v.field("component_id", mavlink.component_id, Range::closed(2, 255), "",
          "Our own component in that system: 1 is the autopilot, 191 an onboard computer");
  v.field("attitude_rate_hz", mavlink.attitude_rate_hz, kRate, "Hz", "Rate at which attitudes are requested");
  v.field("position_rate_hz", mavlink.position_rate_hz, kRate, "Hz", "Rate at which positions are requested");
  v.field("fast_rate_hz", mavlink.fast_rate_hz, Range::closed(0, 50), "Hz",
          "Rate at which attitudes, positions and gimbal angles are requested where the link bears it: "
          "frames wait for the telemetry after them; 0: the rates above always");
  v.field("rangefinder_rate_hz", mavlink.rangefinder_rate_hz, Range::closed(0, 50), "Hz",
          "Rate at which DISTANCE_SENSOR is requested; 0: it is not, but used where it comes");
  v.field(
      "gimbal_rate_hz", mavlink.gimbal_rate_hz, Range::closed(0, 50), "Hz",
      "Rate at which the gimbal's angles are requested where camera.mount.kind is gimbal; 0: they are not, "
      "but used where they come");
  v.field(
      "gimbal", mavlink.gimbal, Range::closed(0, 255), "",
      "The camera's gimbal: 1 to 6 of those that the autopilot drives, or its component (154, 171 to 175); "
      "0: the first one heard");
  v.field(
      "zoom_rate_hz", mavlink.zoom_rate_hz, Range::closed(0, 50), "Hz",
      "Rate at which cameras of the vehicle are asked for their field of view, which tells their zoom; 0: "
      "they are not, but it is used where it comes");
  v.field(
      "zoom_camera", mavlink.zoom_camera, Range::closed(0, 255), "",
      "The camera whose field of view counts: 1 to 6 of those that the autopilot drives, or its component "
      "(100 to 105); 0: the first one heard");
  v.field("link_timeout_s", mavlink.link_timeout_s, Range::closed(0.5, 60), "s",
          "After this silence everything is requested anew");
  v.field("signing_key_file", mavlink.signing_key_file, Any{}, "",
          "Key of MAVLink's message signing, 32 bytes or 64 hexadecimal digits: what is not signed by it is "
          "refused, "
          "what is sent is signed; empty: no signing");
  v.field(
      "signing_state_file", mavlink.signing_state_file, Any{}, "",
      "Where the last signed stamps are kept over restarts; empty: the key's file with .stamps at its end");
  v.field("camera", mavlink.camera, Any{}, "",
          "Be a camera component that tells ground stations where objects are (docs/outputs.md)");
  v.field("camera_component_id", mavlink.camera_component_id, Range::closed(100, 105), "",
          "Its component; the vehicle's own camera is mostly 100");
  v.field("status_text", mavlink.status_text, Any{}, "", "Send STATUSTEXT for each object that is confirmed");
}

}  // namespace geoloc::io
