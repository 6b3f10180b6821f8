// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdlib>
#include <string_view>

#include "geoloc/io/sei/sei_reader.hpp"
#include "geoloc/io/sei/sei_unit.hpp"
#include "geoloc/io/sei/video_telemetry.hpp"

// Telemetry in a video of any bytes: it is refused, or what it tells is usable. Violations abort. Shared by
// the fuzz program and by the test that damages good records.
namespace geoloc::io::hostile {

inline void require_usable(bool holds) {
  if (!holds) std::abort();
}

inline void require_age(Duration age) {
  require_usable(age >= Duration{} && age <= std::chrono::seconds{10});
}

inline void require_angles(const std::optional<VideoTelemetry::Attitude>& told) {
  if (!told) return;
  for (const double angle_rad : {told->angles.roll_rad, told->angles.pitch_rad, told->angles.yaw_rad})
    require_usable(std::abs(angle_rad) <= 6.2832);
  require_age(told->age);
}

/// True where the bytes are a record.
inline bool read_any_telemetry(std::string_view bytes) {
  const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  require_usable(first_slice(data, bytes.size()) <= bytes.size());
  for (const UnitPrefix prefix : {UnitPrefix::kStartCode, UnitPrefix::kLength}) {
    const auto found = unregistered_data_h265(kTelemetryUuid, prefix, data, bytes.size());
    require_usable(!found || found->size() <= bytes.size());
    if (found) parse_video_telemetry(*found);
  }
  const auto told = parse_video_telemetry(bytes);
  if (!told) return false;
  require_usable(told->made_at.time_since_epoch() >= Duration{});
  require_angles(told->vehicle);
  require_angles(told->gimbal);
  if (told->position) {
    require_usable(is_valid(told->position->position));
    require_usable(std::abs(told->position->height_msl_m) <= 1e5);
    require_usable(std::abs(told->position->height_above_home_m) <= 1e5);
    require_age(told->position->age);
  }
  if (told->velocity) {
    require_usable(told->velocity->velocity_in_enu.norm() <= 1e3);
    require_age(told->velocity->age);
  }
  if (told->zoom) require_usable(*told->zoom > 0.0 && *told->zoom < 1e3);
  if (told->horizontal_fov_deg)
    require_usable(*told->horizontal_fov_deg > 0.0 && *told->horizontal_fov_deg < 180.0);
  const std::string again = to_json(*told);
  require_usable(parse_video_telemetry(again).has_value());
  return true;
}

}  // namespace geoloc::io::hostile
