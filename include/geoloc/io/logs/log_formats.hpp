// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "geoloc/io/logs/flight_log.hpp"

// One reader a format. Bytes are hostile: what is damaged is skipped and counted. Each throws
// std::runtime_error, without a file's name, where the bytes are no such log or hold no position.
namespace geoloc::io {

/// ArduPilot's DataFlash log, .BIN: ATT (or AHR2), POS (or AHR2, GPS), GPS, GPA, XKF1/NKF1, ORGN, MNT, CAM,
/// TRIG, MAVC, with the fields of any version since 3.2. Time is since boot.
FlightLog parse_dataflash(std::string_view bytes);

/// PX4's ULog, .ulg: vehicle_attitude, vehicle_global_position (or vehicle_local_position), GNSS, home,
/// gimbal, camera and command topics. Time is since boot.
FlightLog parse_ulog(std::string_view bytes);

/// DJI's subtitles, .SRT, of any of the dialects in docs/import.md. Time is since the video's beginning.
FlightLog parse_srt(std::string_view text);

/// A table whose first line names its columns (docs/formats.md). Time is since 1970 where it is told in UTC.
FlightLog parse_log_table(std::string_view text);

}  // namespace geoloc::io
