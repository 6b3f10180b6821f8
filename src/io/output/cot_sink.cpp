// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/cot_sink.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "geoloc/geometry/refuse.hpp"
#include "geoloc/io/output/cot_event.hpp"
#include "geoloc/io/output/cot_sensor.hpp"

namespace geoloc::io {
namespace {

/// Events after a frame: receivers and radios take a few hundred a second.
constexpr std::size_t kMostAtOnce = 30;
constexpr auto kPatienceAtTheEnd = std::chrono::milliseconds{2000};
constexpr auto kFarewell = std::chrono::milliseconds{1000};

HostTime utc_now() {
  return HostTime{std::chrono::system_clock::now().time_since_epoch()};
}

std::string whole_seconds(HostTime time) {
  return std::to_string(std::chrono::duration_cast<std::chrono::seconds>(time.time_since_epoch()).count());
}

/// Height of home above the ellipsoid, as the objects know it.
std::optional<double> home_ellipsoid_m(const std::vector<ObjectReport>& objects) {
  for (const ObjectReport& object : objects) {
    if (object.height.ellipsoid_m) return *object.height.ellipsoid_m - object.height.above_home_m;
  }
  return std::nullopt;
}

}  // namespace

CotSink::CotSink(std::string target, const CotConfig& config, const CotConnection::Tell& tell)
    : target_(std::move(target)), config_(config), connection_(parse_cot_endpoint(target_), config, tell) {
  refuse_if_any(config.problems());
}

void CotSink::on_frame(const OutputFrame& frame) {
  if (run_.empty()) run_ = whole_seconds(frame.captured_at);
  objects_ = frame.objects;
  if (frame.view) {
    view_ = frame.view;
    view_at_ = frame.captured_at;
  }
  send_due(kMostAtOnce);
}

void CotSink::on_status(const LiveStatus& /*status*/) {
  send_due(kMostAtOnce);
}

void CotSink::on_run(const RunRecord& run) {
  objects_ = run.objects;
}

void CotSink::on_end() {
  if ((objects_.empty() && told_.empty()) || !connection_.flush(kPatienceAtTheEnd)) return;
  tell_all_again();
  send_due(objects_.size());
  if (connection_.flush(kPatienceAtTheEnd)) connection_.end(kFarewell);
}

/// What was told on a connection before may have been lost with it; that an object is gone has yet to be.
void CotSink::tell_all_again() {
  for (auto& [id, told] : told_) told.at.reset();
}

/// Those that nobody was told of come first.
void CotSink::send_due(std::size_t most) {
  const auto now = Clock::now();
  connection_.poll(now);
  if (std::exchange(connections_, connection_.counts().connections) != connections_) tell_all_again();
  send_view();
  const auto is_new = [](const std::optional<Clock::time_point>& told) { return !told; };
  const auto is_due = [&](const std::optional<Clock::time_point>& told) {
    return !told || now - *told >= from_seconds(config_.period_s);
  };
  const std::size_t left = send_those(is_new, 0, now, most);
  send_those(is_due, next_due_, now, left);
  send_gone();
}

/// Sends so many at most of those whose last time `is_wanted`, from the object of that id on, all around.
/// Returns how many more may be sent.
template <typename IsWanted>
std::size_t CotSink::send_those(const IsWanted& is_wanted, std::uint64_t from, Clock::time_point now,
                                std::size_t most) {
  const auto is_before = [](const ObjectReport& object, std::uint64_t id) { return object.id < id; };
  const auto first = static_cast<std::size_t>(
      std::lower_bound(objects_.begin(), objects_.end(), from, is_before) - objects_.begin());
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    const ObjectReport& object = objects_[(first + i) % objects_.size()];
    const auto told = told_.find(object.id);
    if (!is_wanted(told == told_.end() ? std::nullopt : told->second.at) || !has_place(object)) continue;
    if (most == 0 || !connection_.is_ready()) {
      next_due_ = object.id;
      return 0;
    }
    send(object, false);
    told_[object.id] = {object, now};
    --most;
  }
  return most;
}

/// Both are in order of their ids.
void CotSink::send_gone() {
  auto object = objects_.begin();
  for (auto told = told_.begin(); told != told_.end();) {
    while (object != objects_.end() && object->id < told->first) ++object;
    const bool is_there = object != objects_.end() && object->id == told->first;
    if (!is_there && !connection_.is_ready()) return;
    if (!is_there) send(told->second.object, true);
    told = is_there ? std::next(told) : told_.erase(told);
  }
}

/// Each view once.
void CotSink::send_view() {
  const auto now = Clock::now();
  const bool is_due = !view_sent_at_ || now - *view_sent_at_ >= from_seconds(config_.sensor_period_s);
  if (!view_ || !(config_.sensor_period_s > 0.0) || !is_due || !connection_.is_ready()) return;
  CotViewContext context{config_.uid_prefix + "." + run_, view_at_, utc_now(), home_ellipsoid_m(objects_)};
  connection_.send(vehicle_to_cot(*view_, context, config_));
  const std::string point = point_of_interest_to_cot(*view_, context, config_);
  if (!point.empty() && connection_.is_ready()) connection_.send(point);
  view_sent_at_ = now;
  view_.reset();
}

void CotSink::send(const ObjectReport& object, bool is_gone) {
  CotContext context;
  context.uid = config_.uid_prefix + "." + run_ + "." + std::to_string(object.id);
  context.sent_at = utc_now();
  context.is_gone = is_gone;
  connection_.send(to_cot(object, context, config_));
}

}  // namespace geoloc::io
