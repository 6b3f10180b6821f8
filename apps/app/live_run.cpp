// SPDX-License-Identifier: Apache-2.0
#include "app/live_run.hpp"

#include <utility>

namespace geoloc::apps {
namespace {

constexpr auto kTelemetryWait = std::chrono::milliseconds{10};
constexpr int kMostDatagrams = 256;  // a turn: a flood must not starve the frames
constexpr std::size_t kMostWaiting = 128;
constexpr auto kFuture = std::chrono::milliseconds{500};  // clocks disagree a little; more is a wrong clock

}  // namespace

LiveRun::LiveRun(Session& session, io::UdpSocket& socket, io::LinkGuard& guard, DetectionWorker& worker,
                 Recorder& recorder, VehicleReports& reports, const io::HostClock& clock, OnFrame on_frame)
    : session_(session),
      socket_(socket),
      guard_(guard),
      worker_(worker),
      recorder_(recorder),
      reports_(reports),
      clock_(clock),
      on_frame_(std::move(on_frame)) {}

void LiveRun::step() {
  receive_telemetry();
  const auto to_vehicle = [this](const std::uint8_t* frame, std::size_t size) { send(frame, size); };
  session_.link().poll(clock_.now(), to_vehicle);
  reports_.poll(clock_.now(), session_, to_vehicle);
  take_frames();
  process_ready();
}

void LiveRun::receive_telemetry() {
  auto wait = kTelemetryWait;
  for (int i = 0; i < kMostDatagrams; ++i) {
    const auto datagram = socket_.receive(wait);
    if (!datagram) return;
    const HostTime now = clock_.now();
    guard_.receive(now, io::source_of(datagram->sender), datagram->data, datagram->size,
                   [&](const std::uint8_t* frame, std::size_t size) {
                     if (session_.add_telemetry(now, frame, size)) socket_.answer(datagram->sender);
                   });
    wait = std::chrono::milliseconds{0};
  }
}

void LiveRun::send(const std::uint8_t* frame, std::size_t size) {
  const io::OutgoingFrame sent = guard_.outgoing(clock_.now(), frame, size);
  socket_.send(sent.bytes.data(), sent.size);
}

void LiveRun::take_frames() {
  for (DetectedFrame& frame : worker_.take()) {
    const double time_sigma_s = stamp_sigma_.observe(frame.time_quality, frame.received_at);
    if (frame.captured_at <= newest_captured_ || frame.captured_at > clock_.now() + kFuture) {
      ++stats_.out_of_order;
      continue;
    }
    newest_captured_ = frame.captured_at;
    if (waiting_.size() >= kMostWaiting) {
      waiting_.pop_front();
      ++stats_.overflowed;
    }
    waiting_.push_back({std::move(frame), time_sigma_s});
  }
}

void LiveRun::process_ready() {
  while (!waiting_.empty()) {
    const DetectedFrame& frame = waiting_.front().detected;
    const bool waited_enough = clock_.now() - frame.received_at > session_.max_frame_wait();
    if (!session_.is_decided(frame.captured_at) && !waited_enough) return;
    process(waiting_.front());
    waiting_.pop_front();
  }
}

void LiveRun::process(const WaitingFrame& waiting) {
  const DetectedFrame& frame = waiting.detected;
  recorder_.add_frame({frame.captured_at, frame.detections, recorder_.telemetry_records(),
                       waiting.time_sigma_s, io::to_string(frame.time_quality)});
  const PendingFrame pending{frame.captured_at, frame.detections, waiting.time_sigma_s};
  const bool is_located = session_.process(pending);
  if (is_located) stats_.latency_s.add(seconds(clock_.now() - frame.captured_at));
  stats_.time_quality = frame.time_quality;
  if (is_located) reports_.on_frame(session_, frame.captured_at);
  on_frame_(pending, is_located);
}

}  // namespace geoloc::apps
