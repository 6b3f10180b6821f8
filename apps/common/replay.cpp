// SPDX-License-Identifier: Apache-2.0
#include "common/replay.hpp"

namespace geoloc::apps {
namespace {

/// The telemetry of a recording, taken in record by record.
class TelemetryFeed {
 public:
  TelemetryFeed(const io::Tlog& log, Session& session) : records_(log.records()), session_(session) {}

  bool is_empty() const { return next_ == records_.size(); }
  HostTime next_received_at() const { return records_[next_].received_at; }
  std::size_t taken() const { return next_; }

  void take() {
    const io::TlogRecord& record = records_[next_++];
    session_.add_telemetry(record.received_at, record.frame, record.size);
  }

 private:
  const std::vector<io::TlogRecord>& records_;
  Session& session_;
  std::size_t next_ = 0;
};

void take_what_was_known(TelemetryFeed& feed, const io::RecordedFrame& frame, const Session& session) {
  if (frame.telemetry_records) {
    while (!feed.is_empty() && feed.taken() < *frame.telemetry_records) feed.take();
    return;
  }
  while (!feed.is_empty() && feed.next_received_at() <= frame.captured_at) feed.take();
  const HostTime give_up_at = session.gives_up_at(frame.captured_at);
  while (!feed.is_empty() && !session.is_decided(frame.captured_at) &&
         feed.next_received_at() <= give_up_at) {
    feed.take();
  }
}

}  // namespace

void replay(const io::Tlog& telemetry, const std::vector<io::RecordedFrame>& frames, Session& session,
            const std::function<bool(const PendingFrame& frame, bool is_located)>& on_frame) {
  TelemetryFeed feed(telemetry, session);
  for (const io::RecordedFrame& frame : frames) {
    take_what_was_known(feed, frame, session);
    const PendingFrame pending{frame.captured_at, frame.detections, frame.time_sigma_s, frame.mount,
                               frame.focal_px};
    const bool is_located = session.process(pending);
    if (on_frame && !on_frame(pending, is_located)) return session.finish();
  }
  while (!feed.is_empty()) feed.take();  // a live run counts what comes after its last frame, too
  session.finish();
}

}  // namespace geoloc::apps
