// SPDX-License-Identifier: Apache-2.0
#include "import/log_source.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>
#include <utility>

#include "geoloc/io/logs/log_formats.hpp"
#include "geoloc/io/text_file.hpp"
#include "import/link_times.hpp"

namespace geoloc::apps {
namespace {

/// Hours of a log at full rate; all of it is held in memory.
constexpr std::size_t kLargestLog = 1U << 30U;

using Parse = io::FlightLog (*)(std::string_view bytes);

constexpr std::array<std::pair<const char*, Parse>, 5> kFormats{{{".bin", &io::parse_dataflash},
                                                                 {".ulg", &io::parse_ulog},
                                                                 {".ulog", &io::parse_ulog},
                                                                 {".srt", &io::parse_srt},
                                                                 {".csv", &io::parse_log_table}}};

std::string extension_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

Parse parser_for(const std::filesystem::path& file) {
  for (const auto& [extension, parse] : kFormats) {
    if (extension == extension_of(file)) return parse;
  }
  throw std::runtime_error(file.string() +
                           ": what kind of log it is, its name does not tell: .SRT, .BIN, .ulg, "
                           ".tlog or .csv is expected");
}

/// A MAVLink log is stamped by the ground station's clock.
LogSource as_it_is(const std::filesystem::path& file) {
  LogSource source;
  source.telemetry = io::read_tlog(file);
  source.telemetry_has_gimbal = tells_gimbal(*source.telemetry);
  source.times = times_of(*source.telemetry);
  source.begins_at = *source.times.begins_at;
  return source;
}

LogTimes times_of(const io::FlightLog& log, const FlightTrack& track, bool is_subtitled) {
  LogTimes times;
  times.length = track.end - track.begin;
  if (track.is_utc_known) times.begins_at = HostTime{track.begin.time_since_epoch() + track.utc_since_log};
  if (is_subtitled) times.begins_in_video = track.begin.time_since_epoch();
  for (const io::CameraEvent& event : log.camera_events) {
    const Duration since_begin = event.time - track.begin;
    if (event.kind == io::CameraEventKind::kVideoStart) {
      add_start(times.video_starts, since_begin);
    } else {
      times.exposures.push_back(since_begin);
    }
  }
  return times;
}

}  // namespace

LogSource read_log(const std::filesystem::path& file, const TrackFacts& facts) {
  if (extension_of(file) == ".tlog") return as_it_is(file);
  const Parse parse = parser_for(file);
  const std::string bytes = io::read_text_file(file, kLargestLog);
  try {
    io::FlightLog log = parse(bytes);
    LogSource source;
    source.focal_lengths = log.focal_lengths;
    source.track = track_of(log, facts);
    source.times = times_of(log, *source.track, extension_of(file) == ".srt");
    source.begins_at = HostTime{source.track->begin.time_since_epoch() + source.track->utc_since_log};
    return source;
  } catch (const std::exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

}  // namespace geoloc::apps
