// SPDX-License-Identifier: Apache-2.0
#include "app/telemetry_input.hpp"

#include <chrono>
#include <thread>

namespace geoloc::apps {
namespace {

using namespace std::chrono_literals;

constexpr auto kWait = 10ms;
constexpr int kMostDatagrams = 256;  // a turn: a flood must not starve the frames
/// Every frame of a stream with telemetry carries it; this many without any show that there is none.
constexpr std::uint64_t kTellingFrames = 10;

}  // namespace

TelemetryInput::TelemetryInput(const Settings& settings, io::UdpSocket* socket, io::LinkGuard& guard,
                               io::VideoSource& video, const io::HostClock& clock)
    : settings_(settings),
      socket_(socket),
      guard_(guard),
      video_(video),
      clock_(clock),
      way_(settings.is_mavlink_asked_for ? TelemetryWay::kMavlink : TelemetryWay::kUndecided),
      vehicle_(settings.video_system) {}

void TelemetryInput::decide() {
  const io::VideoStatus video = video_.status();
  if (way_ == TelemetryWay::kMavlink && video.with_telemetry > 0 && !has_told_second_) {
    has_told_second_ = true;
    messages_.post(
        settings_.is_mavlink_asked_for
            ? "the video carries telemetry, too, which is not used: --udp asks for MAVLink's"
            : "the video carries telemetry now, which is not used, since its first frames had none");
  }
  if (way_ != TelemetryWay::kUndecided) return;
  if (video.with_telemetry > 0) {
    way_ = TelemetryWay::kVideo;
    messages_.post(
        "the video carries telemetry, which is used: MAVLink is not listened to (--udp asks for it)");
  } else if (video.frames >= kTellingFrames || video.state == io::VideoState::kEnded) {
    way_ = TelemetryWay::kMavlink;
    messages_.post(socket_ != nullptr
                       ? "no telemetry in the video: MAVLink is listened to (--udp [HOST:]PORT says where)"
                       : "no telemetry in the video, and none from elsewhere: give --udp [HOST:]PORT");
  }
}

void TelemetryInput::receive(Session& session) {
  decide();
  if (way_ == TelemetryWay::kVideo) receive_records(session);
  if (can_send()) {
    receive_datagrams(session);
  } else {
    std::this_thread::sleep_for(kWait);
  }
}

void TelemetryInput::receive_datagrams(Session& session) {
  auto wait = kWait;
  for (int i = 0; i < kMostDatagrams; ++i) {
    const auto datagram = socket_->receive(wait);
    if (!datagram) return;
    const HostTime now = clock_.now();
    guard_.receive(now, io::source_of(datagram->sender), datagram->data, datagram->size,
                   [&](const std::uint8_t* frame, std::size_t size) {
                     if (session.add_telemetry(now, frame, size)) socket_->answer(datagram->sender);
                   });
    wait = 0ms;
  }
}

void TelemetryInput::receive_records(Session& session) {
  for (const io::FrameTelemetry& telemetry : video_.take_telemetry()) {
    tell_once(telemetry.record);
    vehicle_.tell(telemetry.made_at, telemetry.record,
                  [&session](HostTime at, const std::uint8_t* frame, std::size_t size) {
                    session.add_telemetry(at, frame, size);
                  });
  }
}

void TelemetryInput::tell_once(const io::VideoTelemetry& record) {
  if (record.gimbal && !settings_.is_on_gimbal && !has_told_gimbal_) {
    has_told_gimbal_ = true;
    messages_.post(
        "the video tells how a gimbal looks, which is not used: if the camera is on it, set "
        "camera.mount.kind to gimbal");
  }
  if (record.refused_values > 0 && !has_told_refused_) {
    has_told_refused_ = true;
    messages_.post("the video tells values that cannot be, or are ten seconds old: they are left out");
  }
}

void TelemetryInput::send(const std::uint8_t* frame, std::size_t size) {
  if (!can_send()) return;
  const io::OutgoingFrame sent = guard_.outgoing(clock_.now(), frame, size);
  socket_->send(sent.bytes.data(), sent.size);
}

}  // namespace geoloc::apps
