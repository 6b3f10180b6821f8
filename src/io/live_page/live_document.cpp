// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/live_page/live_document.hpp"

#include <fmt/format.h>

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
         a.class_id == b.class_id;
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
  set("estimator", page_json::estimator(frame.estimator));
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
}

void LiveDocument::add(const RunRecord& run) {
  const std::lock_guard lock(mutex_);
  publish();
  set("targets", page_json::targets(run.targets));
}

void LiveDocument::announce_picture(std::uint64_t number) {
  const std::lock_guard lock(mutex_);
  publish();
  set("picture", std::to_string(number));
}

void LiveDocument::end() {
  const std::lock_guard lock(mutex_);
  publish();
  set("ended", "true");
}

void LiveDocument::add_objects(const OutputFrame& frame) {
  for (const ObjectReport& report : frame.objects) add_object(report, true, frame.captured_at);
  for (const ObjectReport& report : frame.tentative) add_object(report, false, frame.captured_at);
  for (auto entry = objects_.begin(); entry != objects_.end();) {
    if (entry->second.seen_in == revision_) {
      ++entry;
    } else {
      entry = objects_.erase(entry);
      removed_revision_ = revision_;
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
  std::string json = page_json::object(report, is_confirmed);
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

bool LiveDocument::wait(const Cursor& cursor, std::chrono::milliseconds timeout) const {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, timeout, [&] { return is_closed_ || revision_ > cursor.revision; });
  return !is_closed_ && revision_ > cursor.revision;
}

void LiveDocument::pause_until(std::chrono::steady_clock::time_point time) const {
  std::unique_lock lock(mutex_);
  closing_.wait_until(lock, time, [this] { return is_closed_; });
}

std::string LiveDocument::objects_since(std::uint64_t revision) const {
  std::string json = "[";
  for (const auto& [id, entry] : objects_) {
    if (entry.revision <= revision) continue;
    if (json.size() > 1) json += ',';
    json += entry.json;
  }
  return json + "]";
}

std::string LiveDocument::path_since(const Cursor& cursor) const {
  const std::size_t first = cursor.path_epoch == path_epoch_ ? std::min(cursor.path, path_.size()) : 0;
  std::string json = "[";
  for (std::size_t i = first; i < path_.size(); ++i) {
    fmt::format_to(std::back_inserter(json), "{}[{:.2f},{:.2f}]", i == first ? "" : ",", path_[i].x(),
                   path_[i].y());
  }
  return json + "]";
}

std::string LiveDocument::fixes_since(std::uint64_t first) const {
  const std::uint64_t oldest = fixes_end_ - fixes_.size();
  const auto begin = static_cast<std::size_t>(std::max(first, oldest) - oldest);
  std::string json = "[";
  for (std::size_t i = begin; i < fixes_.size(); ++i) {
    const Fix& fix = fixes_[i];
    fmt::format_to(std::back_inserter(json), "{}[{:.2f},{:.2f},{}]", i == begin ? "" : ",",
                   fix.position_in_enu.x(), fix.position_in_enu.y(), page_json::milliseconds(fix.at));
  }
  return json + "]";
}

std::string LiveDocument::changes(Cursor& cursor) const {
  const std::lock_guard lock(mutex_);
  std::string json;
  page_json::append(json, "revision", std::to_string(revision_));
  for (const auto& [name, part] : parts_) {
    if (part.revision > cursor.revision) page_json::append(json, name, part.json);
  }
  page_json::append(json, "objects", objects_since(cursor.revision));
  if (removed_revision_ > cursor.revision) {
    std::string ids = "[";
    for (const auto& [id, entry] : objects_) ids += (ids.size() > 1 ? "," : "") + std::to_string(id);
    page_json::append(json, "ids", ids + "]");
  }
  if (cursor.path_epoch != path_epoch_) page_json::append(json, "path_begins_anew", "true");
  page_json::append(json, "path", path_since(cursor));
  page_json::append(json, "fixes", fixes_since(cursor.fixes));
  cursor = {revision_, path_.size(), fixes_end_, path_epoch_};
  return json + "}";
}

std::optional<std::string> LiveDocument::object(std::uint64_t id) const {
  const std::lock_guard lock(mutex_);
  const auto found = objects_.find(id);
  if (found == objects_.end()) return std::nullopt;
  const Entry& entry = found->second;
  std::string history = "[";
  for (const Moment& moment : entry.history) {
    fmt::format_to(std::back_inserter(history), "{}[{},{},{:.4f}]", history.size() > 1 ? "," : "",
                   page_json::milliseconds(moment.at), moment.hits,
                   std::isfinite(moment.sigma_major_m) ? moment.sigma_major_m : 0.0);
  }
  return page_json::details(entry.report, entry.json, history + "]");
}

void LiveDocument::close() {
  const std::lock_guard lock(mutex_);
  is_closed_ = true;
  changed_.notify_all();
  closing_.notify_all();
}

bool LiveDocument::is_closed() const {
  const std::lock_guard lock(mutex_);
  return is_closed_;
}

}  // namespace geoloc::io
