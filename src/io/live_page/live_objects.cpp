// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/live_page/live_objects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "page_json.hpp"
#include "thin_out.hpp"

namespace geoloc::io {
namespace {

constexpr std::size_t kMostPictures = 2000;
constexpr std::size_t kMostMoments = 128;
constexpr std::size_t kMostRemovals = 4096;
constexpr std::size_t kMostAtOnce = 4000;   // a megabyte
constexpr double kNoteworthyChange = 0.05;  // of an object's sigma

/// Compares everything that can change on its own.
bool is_same(const ObjectReport& a, const ObjectReport& b) {
  return a.position_in_enu == b.position_in_enu && a.covariance_in_enu == b.covariance_in_enu &&
         a.height.above_home_m == b.height.above_home_m && a.hits == b.hits && a.confidence == b.confidence &&
         a.class_id == b.class_id && a.note == b.note;
}

template <typename Range, typename Text>
std::string json_array(const Range& range, Text text) {
  std::string json = "[";
  for (const auto& one : range) {
    if (json.size() > 1) json += ',';
    json += text(one);
  }
  return json + "]";
}

}  // namespace

LiveObjects::Entry* LiveObjects::find_or_make(std::uint64_t id, std::uint64_t revision) {
  if (next_ == entries_.end() || next_->first != id) next_ = entries_.lower_bound(id);
  const bool is_new = next_ == entries_.end() || next_->first != id;
  if (is_new) {
    if (std::exchange(counted_in_, revision) != revision) not_shown_ = 0;
    if (entries_.size() >= most_) {
      ++not_shown_;
      return nullptr;
    }
    next_ = entries_.emplace_hint(next_, id, Entry{});
    next_->second.place = changed_.insert(changed_.end(), id);
  }
  return &(next_++)->second;
}

void LiveObjects::add(const ObjectReport& report, bool is_confirmed, HostTime at, std::uint64_t revision) {
  if (!report.position_in_enu.allFinite()) return;
  Entry* const entry = find_or_make(report.id, revision);
  if (entry == nullptr) return;
  entry->seen_in = revision;
  const bool is_new = entry->history.empty();
  if (!is_new && is_confirmed == entry->is_confirmed && is_same(report, entry->report)) return;
  confirmed_ += static_cast<std::size_t>(is_confirmed);
  confirmed_ -= static_cast<std::size_t>(entry->is_confirmed);
  entry->report = report;
  entry->is_confirmed = is_confirmed;
  note_moment(*entry, at);
  write_json(report.id, *entry);
}

void LiveObjects::remove_others(std::uint64_t revision, bool only_confirmed) {
  if (counted_in_ != revision) not_shown_ = 0;
  for (auto entry = entries_.begin(); entry != entries_.end();) {
    const bool stays = entry->second.seen_in == revision || (only_confirmed && !entry->second.is_confirmed);
    if (stays) {
      ++entry;
      continue;
    }
    note_removal(entry->first, revision);
    confirmed_ -= static_cast<std::size_t>(entry->second.is_confirmed);
    changed_.erase(entry->second.place);
    entry = entries_.erase(entry);
  }
  next_ = entries_.begin();
}

void LiveObjects::note_removal(std::uint64_t id, std::uint64_t revision) {
  if (removals_.size() == kMostRemovals) {
    removals_forgotten_ = removals_.front().revision;
    removals_.pop_front();
  }
  removals_.push_back({revision, id});
}

void LiveObjects::clear() {
  entries_.clear();
  changed_.clear();
  next_ = entries_.end();
  confirmed_ = not_shown_ = 0;
}

const ObjectReport* LiveObjects::set_note(std::uint64_t id, const ObjectNote& note) {
  const auto found = entries_.find(id);
  if (found == entries_.end() || !found->second.is_confirmed) return nullptr;
  found->second.report.note = note;
  write_json(id, found->second);
  return &found->second.report;
}

bool LiveObjects::set_picture(std::uint64_t id, std::string jpeg) {
  if (pictures_.size() >= kMostPictures && pictures_.count(id) == 0) return false;
  pictures_[id] = {std::make_shared<const std::string>(std::move(jpeg)), ++pictures_made_};
  show_picture_of(id);
  return true;
}

bool LiveObjects::forget_picture(std::uint64_t id) {
  if (pictures_.erase(id) == 0) return false;
  show_picture_of(id);
  return true;
}

/// The object may be unknown as yet.
void LiveObjects::show_picture_of(std::uint64_t id) {
  if (const auto found = entries_.find(id); found != entries_.end()) write_json(id, found->second);
}

std::shared_ptr<const std::string> LiveObjects::picture_of(std::uint64_t id) const {
  const auto found = pictures_.find(id);
  return found == pictures_.end() ? nullptr : found->second.jpeg;
}

std::vector<ObjectReport> LiveObjects::all_confirmed() const {
  std::vector<ObjectReport> reports;
  reports.reserve(confirmed_);
  for (const auto& [id, entry] : entries_) {
    if (entry.is_confirmed) reports.push_back(entry.report);
  }
  return reports;
}

void LiveObjects::write_json(std::uint64_t id, Entry& entry) {
  const auto picture = pictures_.find(id);
  std::string json = page_json::object(entry.report, entry.is_confirmed,
                                       picture == pictures_.end() ? 0 : picture->second.number);
  if (json == entry.json) return;
  entry.json = std::move(json);
  entry.change = ++changes_made_;
  changed_.splice(changed_.end(), changed_, entry.place);
}

/// Records how well an object is known after it was seen again, or after other observations improved its
/// estimate.
void LiveObjects::note_moment(Entry& entry, HostTime at) {
  const double sigma_m = entry.report.ellipse.sigma_major_m;
  if (!entry.history.empty()) {
    const Moment& last = entry.history.back();
    const bool is_news = std::abs(sigma_m - last.sigma_major_m) > kNoteworthyChange * last.sigma_major_m;
    if (entry.report.hits == last.hits && !is_news) return;
  }
  if (entry.history.size() >= kMostMoments) thin_out(entry.history);
  entry.history.push_back({at, entry.report.hits, sigma_m});
}

LiveObjects::Changes LiveObjects::changed_since(std::uint64_t change) const {
  auto id = changed_.end();
  std::size_t count = 0;
  while (id != changed_.begin() && entries_.at(*std::prev(id)).change > change) {
    --id;
    ++count;
  }
  std::vector<const Entry*> news;
  for (; id != changed_.end() && news.size() < kMostAtOnce; ++id) news.push_back(&entries_.at(*id));
  return {json_array(news, [](const Entry* entry) -> const std::string& { return entry->json; }),
          news.empty() ? change : news.back()->change, news.size() == count};
}

std::optional<std::string> LiveObjects::removed_since(std::uint64_t revision) const {
  if (revision < removals_forgotten_) return std::nullopt;
  const auto is_known = [revision](const Removal& removal) { return removal.revision <= revision; };
  const auto known = std::find_if(removals_.rbegin(), removals_.rend(), is_known).base();
  const std::vector<Removal> news(known, removals_.end());
  return json_array(news, [](const Removal& removal) { return std::to_string(removal.id); });
}

std::string LiveObjects::ids() const {
  return json_array(entries_, [](const auto& one) { return std::to_string(one.first); });
}

std::optional<std::string> LiveObjects::details(std::uint64_t id) const {
  const auto found = entries_.find(id);
  if (found == entries_.end()) return std::nullopt;
  const Entry& entry = found->second;
  return page_json::details(entry.report, entry.json, json_array(entry.history, [](const Moment& moment) {
                              return fmt::format(
                                  "[{},{},{:.4f}]", page_json::milliseconds(moment.at), moment.hits,
                                  std::isfinite(moment.sigma_major_m) ? moment.sigma_major_m : 0.0);
                            }));
}

}  // namespace geoloc::io
