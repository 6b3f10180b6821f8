// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/link_sender.hpp"

#include <chrono>

#include "geoloc/io/mavlink/clock_mapping.hpp"
#include "mav_numbers.hpp"
#include "timing.hpp"

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;

/// The clock is needed soon after start and reboot; after that it only drifts.
constexpr Duration kFastTimesyncPeriod = 100ms;
constexpr Duration kTimesyncPeriod = 1s;
constexpr int kFastTimesyncs = 20;
constexpr Duration kTextPeriod = 500ms;
constexpr std::size_t kMostTexts = 20;  // waiting; older ones would be out of date

void send_frame(const OutgoingFrame& frame, const LinkSender::Send& send) {
  send(frame.bytes.data(), frame.size);
}

}  // namespace

void LinkSender::send_heartbeat(HostTime now, const Peers& peers, const Send& send) {
  writer_.use_v2(peers.speaks_v2);
  if (!is_due(last_heartbeat_, kHeartbeatPeriod, now)) return;
  last_heartbeat_ = now;
  send_frame(writer_.heartbeat(peers.self), send);
}

void LinkSender::send_due(HostTime now, const Peers& peers, bool is_clock_in_doubt,
                          StreamRequests& of_vehicle, CameraReceiver& camera, const Send& send) {
  writer_.use_v2(peers.speaks_v2);
  send_timesync(now, peers, is_clock_in_doubt, send);
  send_requests(now, peers, of_vehicle, camera, send);
  send_text(now, peers, send);
}

void LinkSender::say(const std::string& text) {
  if (texts_.size() < kMostTexts) texts_.push_back(text);
}

/// The request is marked with the component that makes it.
void LinkSender::send_timesync(HostTime now, const Peers& peers, bool is_clock_in_doubt, const Send& send) {
  const bool is_fast = fast_timesyncs_ < kFastTimesyncs || is_clock_in_doubt;
  if (!is_due(last_timesync_, is_fast ? kFastTimesyncPeriod : kTimesyncPeriod, now)) return;
  last_timesync_ = now;
  if (fast_timesyncs_ < kFastTimesyncs) ++fast_timesyncs_;
  const auto now_us = std::chrono::duration_cast<std::chrono::microseconds>(now.time_since_epoch());
  const std::int64_t marked_ns = now_us.count() * kNanosecondsPerStamp + peers.self.component;
  send_frame(writer_.timesync_request(peers.self, marked_ns), send);
}

void LinkSender::send_requests(HostTime now, const Peers& peers, StreamRequests& of_vehicle,
                               CameraReceiver& camera, const Send& send) {
  const auto ask = [&](MavAddress whom, const StreamRequest& request) {
    const WantedStream& stream = request.stream;
    const bool is_old_way = request.method == StreamRequest::Method::kDataStream;
    send_frame(is_old_way ? writer_.request_data_stream(peers.self, whom, stream.data_stream, stream.rate_hz)
                          : writer_.set_message_interval(peers.self, whom, stream.message_id, stream.rate_hz),
               send);
  };
  while (const auto request = of_vehicle.next(now)) ask(peers.vehicle, *request);
  while (const auto request = camera.next_request(now))
    send_frame(writer_.set_message_interval(peers.self, {peers.vehicle.system, camera.asked_component()},
                                            request->stream.message_id, request->stream.rate_hz),
               send);
}

void LinkSender::send_text(HostTime now, const Peers& peers, const Send& send) {
  if (texts_.empty() || !is_due(last_text_, kTextPeriod, now)) return;
  last_text_ = now;
  send_frame(writer_.status_text(peers.self, texts_.front()), send);
  texts_.pop_front();
}

}  // namespace geoloc::io
