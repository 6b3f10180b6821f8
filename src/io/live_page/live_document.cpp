// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/live_page/live_document.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "page_json.hpp"
#include "thin_out.hpp"

namespace geoloc::io {
namespace {

constexpr std::size_t kMostPathPoints = 4096;
constexpr double kPathSpacing_m = 0.3;
constexpr std::size_t kMostFixes = 3000;

}  // namespace

LiveDocument::LiveDocument(const LivePageTitle& title, std::size_t most_objects) : objects_(most_objects) {
  publish();
  set("run", page_json::title(title));
}

void LiveDocument::set(const std::string& name, std::string json) {
  Part& part = parts_[name];
  if (part.json == json) return;
  part = {std::move(json), revision_};
}

void LiveDocument::publish() {
  ++revision_;
  changed_.notify_all();
}

void LiveDocument::add(const OutputFrame& frame) {
  const std::lock_guard lock(mutex_);
  publish();
  for (const ObjectReport& report : frame.objects) objects_.add(report, true, frame.captured_at, revision_);
  for (const ObjectReport& report : frame.tentative)
    objects_.add(report, false, frame.captured_at, revision_);
  objects_.remove_others(revision_, false);
  count_objects();
  run_.estimator = frame.estimator;
  set("estimator", page_json::estimator(frame.estimator));
  newest_at_ = frame.captured_at;
  if (!frame.view || !frame.view->vehicle_in_enu.allFinite()) return;
  set("view", page_json::view(frame));
  if (parts_.count("anchor") == 0) set("anchor", page_json::anchor(*frame.view));
  add_path(frame.view->vehicle_in_enu.head<2>());
  add_fixes(frame);
}

void LiveDocument::add(const LiveStatus& status) {
  const std::lock_guard lock(mutex_);
  publish();
  set("status", page_json::status(status));
  status_ = status;
}

void LiveDocument::add(const RunRecord& run) {
  const std::lock_guard lock(mutex_);
  publish();
  set("targets", page_json::targets(run.targets));
  set("estimator", page_json::estimator(run.estimator));
  if (!run.flights.empty()) set("flights", page_json::flights(run.flights));
  if (!run.flights.empty() && run.local_frame) set("anchor", page_json::anchor(run.local_frame->origin()));
  run_.title = run.title;
  run_.summary = run.summary;
  run_.estimator = run.estimator;
  run_.local_frame = run.local_frame;
  run_.ground_height_above_home_m = run.ground_height_above_home_m;
  run_.trajectory = run.trajectory;
  for (const ObjectReport& report : run.objects)
    objects_.add(report, true, std::max(newest_at_, report.last_seen), revision_);
  objects_.remove_others(revision_, true);
  count_objects();
}

std::optional<NotedObject> LiveDocument::note(std::uint64_t id, const ObjectNote& note) {
  const std::lock_guard lock(mutex_);
  const ObjectReport* const object = objects_.set_note(id, note);
  if (object == nullptr) return std::nullopt;
  publish();
  return NotedObject{newest_at_, id, object->position, note};
}

std::uint64_t LiveDocument::revision() const {
  const std::lock_guard lock(mutex_);
  return revision_;
}

RunRecord LiveDocument::record() const {
  const std::lock_guard lock(mutex_);
  RunRecord run = run_;
  run.objects = objects_.all_confirmed();
  return run;
}

RunFigures LiveDocument::figures() const {
  const std::lock_guard lock(mutex_);
  return {status_, run_.estimator, objects_.counts().confirmed};
}

void LiveDocument::show_object(std::uint64_t id, std::string jpeg) {
  const std::lock_guard lock(mutex_);
  if (objects_.set_picture(id, std::move(jpeg))) publish();
}

void LiveDocument::forget_picture(std::uint64_t id) {
  const std::lock_guard lock(mutex_);
  if (objects_.forget_picture(id)) publish();
}

std::shared_ptr<const std::string> LiveDocument::picture_of(std::uint64_t id) const {
  const std::lock_guard lock(mutex_);
  return objects_.picture_of(id);
}

void LiveDocument::announce_picture(std::uint64_t number) {
  const std::lock_guard lock(mutex_);
  publish();
  set("picture", std::to_string(number));
}

void LiveDocument::show_playback(const std::string& json) {
  const std::lock_guard lock(mutex_);
  if (parts_["playback"].json == json) return;
  publish();
  set("playback", json);
}

void LiveDocument::begin_anew() {
  const std::lock_guard lock(mutex_);
  publish();
  for (auto part = parts_.begin(); part != parts_.end();) {
    const std::string& name = part->first;
    const bool is_kept = name == "run" || name == "targets" || name == "playback";
    part->second.revision = revision_;  // a page forgets everything when it is told of a run
    part = is_kept ? std::next(part) : parts_.erase(part);
  }
  objects_.clear();
  path_.clear();
  ++path_epoch_;
  fixes_.clear();
}

void LiveDocument::end() {
  const std::lock_guard lock(mutex_);
  publish();
  set("ended", "true");
}

/// Objects beyond what a page can show.
void LiveDocument::count_objects() {
  const std::size_t not_shown = objects_.counts().not_shown;
  if (not_shown > 0 || parts_.count("not_shown") > 0) set("not_shown", std::to_string(not_shown));
}

void LiveDocument::add_path(const Eigen::Vector2d& position_in_enu) {
  if (!position_in_enu.allFinite()) return;
  if (!path_.empty() && (position_in_enu - path_.back()).norm() < kPathSpacing_m) return;
  if (path_.size() >= kMostPathPoints) {
    thin_out(path_);
    ++path_epoch_;
  }
  path_.push_back(position_in_enu);
}

void LiveDocument::add_fixes(const OutputFrame& frame) {
  for (const FixReport& fix : frame.fixes) {
    if (!fix.ground.position_in_enu.allFinite()) continue;
    if (fixes_.size() >= kMostFixes) fixes_.pop_front();
    fixes_.push_back({fix.ground.position_in_enu, fix.detection.confidence, frame.captured_at});
    ++fixes_end_;
  }
}

}  // namespace geoloc::io
