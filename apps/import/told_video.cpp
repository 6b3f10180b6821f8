// SPDX-License-Identifier: Apache-2.0
#include "import/told_video.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "common/video_vehicle.hpp"
#include "import/video_looks.hpp"

namespace geoloc::apps {
namespace {

/// As joint.prior.sigma_latency_s has it by default: what cameras are late by.
constexpr double kLatencySigma_s = 0.3;
/// Fields of view that differ by less are one, rounded: the zoom stays as it is.
constexpr double kSameFov_deg = 0.1;

/// Collects records of a MAVLink log.
class TlogMaker {
 public:
  void add(HostTime at, const std::uint8_t* frame, std::size_t size) {
    const auto stamp = io::tlog_stamp(std::chrono::floor<std::chrono::microseconds>(at.time_since_epoch()));
    bytes_.insert(bytes_.end(), stamp.begin(), stamp.end());
    bytes_.insert(bytes_.end(), frame, frame + size);
  }

  io::Tlog take() { return io::Tlog(std::move(bytes_)); }

 private:
  std::vector<std::uint8_t> bytes_;
};

/// What is told of the camera, and whether it stays so.
void note_camera(const io::VideoTelemetry& record, ToldVideo& video, bool& has_zoomed) {
  video.has_gimbal = video.has_gimbal || record.gimbal;
  if (!record.horizontal_fov_deg) return;
  if (!video.horizontal_fov_deg) video.horizontal_fov_deg = record.horizontal_fov_deg;
  has_zoomed = has_zoomed || std::abs(*record.horizontal_fov_deg - *video.horizontal_fov_deg) > kSameFov_deg;
}

void take_times(ToldVideo& video) {
  const auto told = std::find_if(video.made_at.begin(), video.made_at.end(),
                                 [](const auto& made_at) { return made_at.has_value(); });
  const auto& records = video.log.telemetry->records();
  video.log.begins_at = records.front().received_at;
  video.log.times.begins_at = video.log.begins_at;
  video.log.times.length = records.back().received_at - video.log.begins_at;
  video.begins_at = **told;
  video.offset = {video.begins_at - video.log.begins_at, kLatencySigma_s, "by the telemetry in its frames"};
}

}  // namespace

ToldVideo read_told_video(const std::filesystem::path& file, const StopSignal& stop) {
  ToldVideo video;
  TlogMaker log;
  VideoVehicle vehicle(1);
  bool has_zoomed = false;
  std::size_t records = 0, refused = 0;
  for_each_frame(file, "reading the telemetry", stop, video.notes,
                 [&](std::uint64_t number, const io::VideoFrame& frame) {
                   video.made_at.resize(number + 1);
                   if (!frame.telemetry) return;
                   const io::VideoTelemetry& record = frame.telemetry->record;
                   const HostTime made_at{record.made_at.time_since_epoch()};
                   video.made_at.back() = made_at;
                   ++records;
                   refused += record.refused_values > 0 ? 1 : 0;
                   note_camera(record, video, has_zoomed);
                   vehicle.tell(made_at, record,
                                [&log](HostTime at, const std::uint8_t* message, std::size_t size) {
                                  log.add(at, message, size);
                                });
                 });
  if (records == 0 && !stop.is_requested())
    throw std::runtime_error(file.string() +
                             ": carries no telemetry (docs/video.md): give the flight's log "
                             "with --log");
  video.log.telemetry = log.take();
  if (records > 0) take_times(video);
  video.notes.push_back(
      fmt::format("telemetry in {} of {} frames is the flight's log", records, video.made_at.size()));
  if (refused > 0)
    video.notes.push_back(fmt::format("{} of them tell values that cannot be, which are left out", refused));
  if (has_zoomed)
    video.notes.emplace_back(
        "the camera zooms: its frames tell the field of view, and the calibration is that of the first one");
  return video;
}

std::size_t take_told_times(const ToldVideo& video, std::vector<VideoLook>& looks) {
  std::vector<VideoLook> timed;
  std::optional<HostTime> newest;
  for (VideoLook& look : looks) {
    const auto made_at = look.frame < video.made_at.size() ? video.made_at[look.frame] : std::nullopt;
    if (!made_at || (newest && *made_at <= *newest)) continue;
    newest = made_at;
    look.time = *made_at - video.begins_at;
    timed.push_back(std::move(look));
  }
  const std::size_t left_out = looks.size() - timed.size();
  looks = std::move(timed);
  return left_out;
}

}  // namespace geoloc::apps
