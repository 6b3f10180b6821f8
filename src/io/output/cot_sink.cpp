// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/cot_sink.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "geoloc/geometry/problems.hpp"
#include "geoloc/io/output/cot_event.hpp"

namespace geoloc::io {
namespace {

constexpr auto kPatienceAtTheEnd = std::chrono::milliseconds{2000};
constexpr auto kFarewell = std::chrono::milliseconds{1000};

HostTime utc_now() {
  return HostTime{std::chrono::system_clock::now().time_since_epoch()};
}

std::string whole_seconds(HostTime time) {
  return std::to_string(std::chrono::duration_cast<std::chrono::seconds>(time.time_since_epoch()).count());
}

}  // namespace

CotSink::CotSink(std::string target, const CotConfig& config, const CotConnection::Tell& tell)
    : target_(std::move(target)), config_(config), connection_(parse_cot_endpoint(target_), config, tell) {
  throw_if_any(config.problems());
}

void CotSink::on_frame(const OutputFrame& frame) {
  if (run_.empty()) run_ = whole_seconds(frame.captured_at);
  objects_ = frame.objects;
  send_due();
}

void CotSink::on_status(const LiveStatus& /*status*/) {
  send_due();
}

void CotSink::on_run(const RunRecord& run) {
  objects_ = run.objects;
}

void CotSink::on_end() {
  if ((objects_.empty() && told_.empty()) || !connection_.flush(kPatienceAtTheEnd)) return;
  tell_all_again();
  send_due();
  if (connection_.flush(kPatienceAtTheEnd)) connection_.end(kFarewell);
}

/// What was told on a connection before may have been lost with it; that an object is gone has yet to be.
void CotSink::tell_all_again() {
  for (auto& [id, told] : told_) told.at.reset();
}

void CotSink::send_due() {
  const auto now = CotConnection::Clock::now();
  connection_.poll(now);
  if (std::exchange(connections_, connection_.counts().connections) != connections_) tell_all_again();
  for (const ObjectReport& object : objects_) {
    const auto told = told_.find(object.id);
    const bool is_due =
        told == told_.end() || !told->second.at || now - *told->second.at >= from_seconds(config_.period_s);
    if (!is_due || !has_place(object)) continue;
    if (!connection_.is_ready()) return;
    send(object, false);
    told_[object.id] = {object, now};
  }
  for (auto told = told_.begin(); told != told_.end();) {
    const bool is_there = std::any_of(objects_.begin(), objects_.end(),
                                      [&](const ObjectReport& object) { return object.id == told->first; });
    if (!is_there && !connection_.is_ready()) return;
    if (!is_there) send(told->second.object, true);
    told = is_there ? std::next(told) : told_.erase(told);
  }
}

void CotSink::send(const ObjectReport& object, bool is_gone) {
  CotContext context;
  context.uid = config_.uid_prefix + "." + run_ + "." + std::to_string(object.id);
  context.sent_at = utc_now();
  context.is_gone = is_gone;
  connection_.send(to_cot(object, context, config_));
}

}  // namespace geoloc::io
