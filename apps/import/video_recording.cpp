// SPDX-License-Identifier: Apache-2.0
#include "import/video_recording.hpp"

#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

#include "geoloc/io/mavlink/state_messages.hpp"
#include "import/gimbal_mount.hpp"
#include "import/video_camera.hpp"

namespace geoloc::apps {
namespace {

using namespace std::chrono_literals;

/// How far video and log may be apart is the latency that the joint method finds.
nlohmann::ordered_json settings_for(const VideoFlight& flight) {
  const LogSource& log = flight.log;
  constexpr double kCourseSigma_deg = 10.0;  // wind
  nlohmann::ordered_json prior{{"sigma_latency_s", flight.offset.sigma_s}};
  const double sigma_focal_percent = flight.camera.sigma_focal_percent;
  if (sigma_focal_percent > 0.0) prior["sigma_focal_percent"] = sigma_focal_percent;
  nlohmann::ordered_json joint;
  if (log.track && log.track->is_heading_assumed) prior["sigma_boresight_z_deg"] = kCourseSigma_deg;
  if (log.track && log.track->sigma_attitude_deg > 0.0)
    joint["sigma_attitude_deg"] = log.track->sigma_attitude_deg;
  joint["prior"] = std::move(prior);
  return {{"joint", std::move(joint)}};
}

/// Tells the track in the messages of an autopilot, in the order of their times.
class TrackTeller {
 public:
  TrackTeller(const FlightTrack& track, io::RecordingWriter& writer) : track_(track), writer_(writer) {}

  void tell() {
    auto attitude = track_.attitudes.begin();
    auto position = track_.positions.begin();
    auto fix = track_.fixes.begin();
    auto gimbal = track_.gimbal.begin();
    const auto is_due = [](auto it, const auto& list, VehicleTime before) {
      return it != list.end() && it->time <= before;
    };
    for (; attitude != track_.attitudes.end(); ++attitude) {
      for (; is_due(position, track_.positions, attitude->time); ++position) tell_position(*position);
      for (; is_due(fix, track_.fixes, attitude->time); ++fix) tell_fix(*fix);
      for (; is_due(gimbal, track_.gimbal, attitude->time); ++gimbal) tell_gimbal(*gimbal);
      AttitudeSample sample = *attitude;
      sample.time = boot_time(attitude->time);
      add(attitude->time, state_.attitude(sample));
    }
    for (; position != track_.positions.end(); ++position) tell_position(*position);
    for (; gimbal != track_.gimbal.end(); ++gimbal) tell_gimbal(*gimbal);
  }

 private:
  /// The log begins a second after the boot.
  VehicleTime boot_time(VehicleTime time) const { return VehicleTime{time - track_.begin + 1s}; }

  void add(VehicleTime time, const io::OutgoingFrame& frame) {
    const HostTime at{time.time_since_epoch() + track_.utc_since_log};
    if (!is_begun_ || at - heartbeat_at_ >= 1s) {
      is_begun_ = true;
      heartbeat_at_ = at;
      const io::OutgoingFrame heartbeat = state_.heartbeat();
      writer_.add_telemetry(at, heartbeat.bytes.data(), heartbeat.size);
    }
    writer_.add_telemetry(at, frame.bytes.data(), frame.size);
  }

  void tell_position(const PositionSample& position) {
    PositionSample sample = position;
    sample.time = boot_time(position.time);
    add(position.time, state_.position(sample));
  }

  void tell_fix(const io::LoggedFix& fix) {
    if (fix.time < track_.begin) return;
    PositionSample place;
    place.time = boot_time(fix.time);
    place.position = fix.position;
    place.height_msl_m = fix.height_msl_m;
    add(fix.time, state_.gnss(place, {static_cast<std::uint8_t>(fix.fix_type), fix.sigma_horizontal_m,
                                      fix.sigma_height_m}));
  }

  void tell_gimbal(const io::LoggedGimbal& logged) {
    if (logged.time < track_.begin) return;
    const GimbalSample sample{boot_time(logged.time), ned_from_body(logged.angles), logged.yaw,
                              logged.holds_direction};
    add(logged.time, state_.gimbal(sample));
  }

  const FlightTrack& track_;
  io::RecordingWriter& writer_;
  io::StateWriter state_;
  HostTime heartbeat_at_;
  bool is_begun_ = false;
};

void write_telemetry(const LogSource& log, io::RecordingWriter& writer) {
  if (log.track) TrackTeller(*log.track, writer).tell();
  if (!log.telemetry) return;
  for (const io::TlogRecord& record : log.telemetry->records())
    writer.add_telemetry(record.received_at, record.frame, record.size);
}

}  // namespace

std::size_t write_video_flight(const VideoFlight& flight, io::RecordingWriter& writer) {
  const LogSource& log = flight.log;
  CameraConfig camera = flight.camera.config;
  if (log.has_gimbal()) camera.mount = told_mount(camera.mount);
  if (log.track && !log.track->assumed_gimbal.empty()) camera.mount.kind = MountKind::kFixed;
  writer.write_camera(camera);
  writer.write_config(settings_for(flight).dump(2));
  write_telemetry(log, writer);
  std::size_t left_out = 0;
  for (const VideoLook& look : flight.looks) {
    const Duration since_log_begin = flight.offset.after_log_begin + look.time;
    io::RecordedFrame frame;
    frame.captured_at =
        std::chrono::floor<std::chrono::microseconds>((log.begins_at + since_log_begin).time_since_epoch()) +
        HostTime{};
    frame.detections = look.detections;
    frame.time_quality = io::to_string(flight.time_quality);
    frame.time_sigma_s = flight.time_sigma_s;
    if (log.track)
      frame.focal_px = focal_px_at(log.focal_lengths, camera.intrinsics, log.track->begin + since_log_begin);
    if (log.track && !log.track->assumed_gimbal.empty()) {
      frame.mount = assumed_mount(*log.track, camera.mount, log.track->begin + since_log_begin);
      if (!frame.mount) {
        ++left_out;
        continue;
      }
    }
    writer.add_frame(frame);
  }
  return left_out;
}

}  // namespace geoloc::apps
