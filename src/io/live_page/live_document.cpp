// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/live_page/live_document.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "page_json.hpp"

namespace geoloc::io {
namespace {

constexpr std::size_t kMostPathPoints = 4096;
constexpr double kPathSpacing_m = 0.3;
constexpr std::size_t kMostFixes = 3000;
constexpr std::size_t kMostObjects = 5000;
constexpr std::size_t kMostPictures = 2000;
constexpr std::size_t kMostMoments = 128;
constexpr double kNoteworthyChange = 0.05;  // of an object's sigma

/// Drops every second entry, so that the rest covers the same time.
template <typename T>
void thin_out(std::vector<T>& entries) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < entries.size(); i += 2) entries[kept++] = entries[i];
  entries.erase(entries.begin() + static_cast<std::ptrdiff_t>(kept), entries.end());
}

/// Compares everything that can change on its own.
bool is_same(const ObjectReport& a, const ObjectReport& b) {
  return a.position_in_enu == b.position_in_enu && a.covariance_in_enu == b.covariance_in_enu &&
         a.height.above_home_m == b.height.above_home_m && a.hits == b.hits && a.confidence == b.confidence &&
         a.class_id == b.class_id && a.note == b.note;
}

}  // namespace

LiveDocument::LiveDocument(const LivePageTitle& title) {
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
  add_objects(frame);
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
    add_object(report, true, std::max(newest_at_, report.last_seen));
  remove_objects([this](const Entry& entry) { return entry.is_confirmed && entry.seen_in != revision_; });
}

std::optional<NotedObject> LiveDocument::note(std::uint64_t id, const ObjectNote& note) {
  const std::lock_guard lock(mutex_);
  const auto found = objects_.find(id);
  if (found == objects_.end() || !found->second.is_confirmed) return std::nullopt;
  publish();
  Entry& entry = found->second;
  entry.report.note = note;
  write_json(id, entry);
  return NotedObject{newest_at_, id, entry.report.position, note};
}

std::uint64_t LiveDocument::revision() const {
  const std::lock_guard lock(mutex_);
  return revision_;
}

RunRecord LiveDocument::record() const {
  const std::lock_guard lock(mutex_);
  RunRecord run = run_;
  for (const auto& [id, entry] : objects_) {
    if (entry.is_confirmed) run.objects.push_back(entry.report);
  }
  return run;
}

RunFigures LiveDocument::figures() const {
  const std::lock_guard lock(mutex_);
  const auto confirmed = std::count_if(objects_.begin(), objects_.end(),
                                       [](const auto& one) { return one.second.is_confirmed; });
  return {status_, run_.estimator, static_cast<std::size_t>(confirmed)};
}

void LiveDocument::show_object(std::uint64_t id, std::string jpeg) {
  const std::lock_guard lock(mutex_);
  if (pictures_.size() >= kMostPictures && pictures_.count(id) == 0) return;
  publish();
  pictures_[id] = {std::make_shared<const std::string>(std::move(jpeg)), ++pictures_made_};
  if (const auto found = objects_.find(id); found != objects_.end()) write_json(id, found->second);
}

void LiveDocument::forget_picture(std::uint64_t id) {
  const std::lock_guard lock(mutex_);
  if (pictures_.erase(id) == 0) return;
  const auto found = objects_.find(id);
  if (found == objects_.end()) return;
  publish();
  write_json(id, found->second);
}

std::shared_ptr<const std::string> LiveDocument::picture_of(std::uint64_t id) const {
  const std::lock_guard lock(mutex_);
  const auto found = pictures_.find(id);
  return found == pictures_.end() ? nullptr : found->second.jpeg;
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

void LiveDocument::add_objects(const OutputFrame& frame) {
  for (const ObjectReport& report : frame.objects) add_object(report, true, frame.captured_at);
  for (const ObjectReport& report : frame.tentative) add_object(report, false, frame.captured_at);
  remove_objects([this](const Entry& entry) { return entry.seen_in != revision_; });
}

void LiveDocument::remove_objects(const std::function<bool(const Entry&)>& is_gone) {
  for (auto entry = objects_.begin(); entry != objects_.end();) {
    if (is_gone(entry->second)) {
      entry = objects_.erase(entry);
      removed_revision_ = revision_;
    } else {
      ++entry;
    }
  }
}

void LiveDocument::add_object(const ObjectReport& report, bool is_confirmed, HostTime at) {
  if (!report.position_in_enu.allFinite()) return;
  if (objects_.size() >= kMostObjects && objects_.find(report.id) == objects_.end()) return;
  Entry& entry = objects_[report.id];
  entry.seen_in = revision_;
  const bool is_new = entry.history.empty();
  if (!is_new && is_confirmed == entry.is_confirmed && is_same(report, entry.report)) return;
  entry.report = report;
  entry.is_confirmed = is_confirmed;
  note_moment(entry, at);
  write_json(report.id, entry);
}

void LiveDocument::write_json(std::uint64_t id, Entry& entry) const {
  const auto picture = pictures_.find(id);
  std::string json = page_json::object(entry.report, entry.is_confirmed,
                                       picture == pictures_.end() ? 0 : picture->second.number);
  if (json == entry.json) return;
  entry.json = std::move(json);
  entry.revision = revision_;
}

/// Records how well an object is known after it was seen again, or after other observations improved its
/// estimate.
void LiveDocument::note_moment(Entry& entry, HostTime at) {
  const double sigma_m = entry.report.ellipse.sigma_major_m;
  if (!entry.history.empty()) {
    const Moment& last = entry.history.back();
    const bool is_news = std::abs(sigma_m - last.sigma_major_m) > kNoteworthyChange * last.sigma_major_m;
    if (entry.report.hits == last.hits && !is_news) return;
  }
  if (entry.history.size() >= kMostMoments) thin_out(entry.history);
  entry.history.push_back({at, entry.report.hits, sigma_m});
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
