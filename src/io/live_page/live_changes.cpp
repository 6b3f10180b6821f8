// SPDX-License-Identifier: Apache-2.0
// What LiveDocument tells pages, and how they wait for it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "geoloc/io/live_page/live_document.hpp"
#include "page_json.hpp"

namespace geoloc::io {

bool LiveDocument::wait(const Cursor& cursor, std::chrono::milliseconds timeout) const {
  std::unique_lock lock(mutex_);
  const auto has_news = [&] { return cursor.has_more || revision_ > cursor.revision; };
  changed_.wait_for(lock, timeout, [&] { return is_closed_ || has_news(); });
  return !is_closed_ && has_news();
}

void LiveDocument::pause_until(std::chrono::steady_clock::time_point time) const {
  std::unique_lock lock(mutex_);
  closing_.wait_until(lock, time, [this] { return is_closed_; });
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

/// All ids that there are where a page has not looked for long.
void LiveDocument::append_removals(std::uint64_t since, std::string& json) const {
  if (const auto removed = objects_.removed_since(since)) {
    if (*removed != "[]") page_json::append(json, "removed", *removed);
  } else {
    page_json::append(json, "ids", objects_.ids());
  }
}

std::string LiveDocument::changes(Cursor& cursor) const {
  const std::lock_guard lock(mutex_);
  std::string json;
  page_json::append(json, "revision", std::to_string(revision_));
  for (const auto& [name, part] : parts_) {
    if (part.revision > cursor.revision) page_json::append(json, name, part.json);
  }
  const LiveObjects::Changes objects = objects_.changed_since(cursor.objects);
  page_json::append(json, "objects", objects.objects);
  if (!objects.are_all) page_json::append(json, "more", "true");
  if (cursor.revision > 0) append_removals(cursor.revision, json);
  if (cursor.path_epoch != path_epoch_) page_json::append(json, "path_begins_anew", "true");
  page_json::append(json, "path", path_since(cursor));
  page_json::append(json, "fixes", fixes_since(cursor.fixes));
  cursor = {revision_, path_.size(), fixes_end_, path_epoch_, objects.last, !objects.are_all};
  return json + "}";
}

std::optional<std::string> LiveDocument::object(std::uint64_t id) const {
  const std::lock_guard lock(mutex_);
  return objects_.details(id);
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
