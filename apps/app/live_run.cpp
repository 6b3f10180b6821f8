// SPDX-License-Identifier: Apache-2.0
#include "app/live_run.hpp"

#include <utility>

namespace geoloc::apps {
namespace {

constexpr std::size_t kMostWaiting = 128;
constexpr auto kFuture = std::chrono::milliseconds{500};  // clocks disagree a little; more is a wrong clock

}  // namespace

LiveRun::LiveRun(Session& session, TelemetryInput& telemetry, DetectionWorker& worker, Recorder& recorder,
                 VehicleReports& reports, const io::HostClock& clock, OnFrame on_frame)
    : session_(session),
      telemetry_(telemetry),
      worker_(worker),
      recorder_(recorder),
      reports_(reports),
      clock_(clock),
      on_frame_(std::move(on_frame)) {}

void LiveRun::step() {
  telemetry_.receive(session_);
  if (telemetry_.can_send()) answer_vehicle();
  if (telemetry_.way() != TelemetryWay::kUndecided) take_frames();
  process_ready();
}

void LiveRun::answer_vehicle() {
  const auto to_vehicle = [this](const std::uint8_t* frame, std::size_t size) {
    telemetry_.send(frame, size);
  };
  session_.link().poll(clock_.now(), to_vehicle);
  reports_.poll(clock_.now(), session_, to_vehicle);
}

/// By the time at which its own telemetry says that it was made, so that both are of one clock. False where
/// it has none.
bool LiveRun::stamp_by_telemetry(DetectedFrame& frame) {
  if (!frame.telemetry) return false;
  frame.captured_at = frame.telemetry->made_at;
  frame.time_quality = io::TimeQuality::kTelemetry;
  return true;
}

void LiveRun::take_frames() {
  for (DetectedFrame& frame : worker_.take()) {
    if (telemetry_.way() == TelemetryWay::kVideo && !stamp_by_telemetry(frame)) {
      ++stats_.untold;
      continue;
    }
    wait_for_state(std::move(frame));
  }
}

void LiveRun::wait_for_state(DetectedFrame frame) {
  const double time_sigma_s = stamp_sigma_.observe(frame.time_quality, frame.received_at);
  if (frame.captured_at <= newest_captured_ || frame.captured_at > clock_.now() + kFuture) {
    ++stats_.out_of_order;
    return;
  }
  newest_captured_ = frame.captured_at;
  if (waiting_.size() >= kMostWaiting) {
    waiting_.pop_front();
    ++stats_.overflowed;
  }
  waiting_.push_back({std::move(frame), time_sigma_s});
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
  if (is_located) note_delays(frame);
  stats_.time_quality = frame.time_quality;
  if (is_located) reports_.on_frame(session_, frame.captured_at);
  on_frame_(pending, is_located);
}

void LiveRun::note_delays(const DetectedFrame& frame) {
  const HostTime now = clock_.now();
  stats_.latency_s.add(seconds(now - frame.captured_at));
  stats_.delays.to_arrival.add(frame.received_at - frame.captured_at);
  stats_.delays.in_search.add(frame.searched_at - frame.received_at);
  stats_.delays.in_wait.add(now - frame.searched_at);
  stats_.delays.total.add(now - frame.captured_at);
}

}  // namespace geoloc::apps
