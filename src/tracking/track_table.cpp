// SPDX-License-Identifier: Apache-2.0
#include "tracking/track_table.hpp"

#include <algorithm>

namespace geoloc {

TrackTable::TrackTable(int max_tracks) : max_tracks_(max_tracks) {
  rows_.reserve(max_tracks_);
  landmarks_.reserve(max_tracks_);
  free_landmarks_.reserve(max_tracks_);
  landmarks_of_rows_.reserve(max_tracks_);
}

const std::vector<const Landmark*>& TrackTable::landmarks() {
  landmarks_of_rows_.clear();
  for (const RestingObject& row : rows_) landmarks_of_rows_.push_back(row.landmark);
  return landmarks_of_rows_;
}

RestingObject* TrackTable::find(std::uint64_t track_id) {
  const auto is_before = [](const RestingObject& row, std::uint64_t id) { return row.track.id < id; };
  const auto row = std::lower_bound(rows_.begin(), rows_.end(), track_id, is_before);
  return row != rows_.end() && row->track.id == track_id ? &*row : nullptr;
}

RestingObject& TrackTable::append() {
  RestingObject& row = rows_.emplace_back();
  if (free_landmarks_.empty()) {
    row.landmark = &landmarks_.emplace_back();
  } else {
    row.landmark = free_landmarks_.back();
    free_landmarks_.pop_back();
  }
  return row;
}

void TrackTable::remove(std::size_t row) {
  free_landmarks_.push_back(rows_[row].landmark);
  rows_.erase(rows_.begin() + static_cast<std::ptrdiff_t>(row));
}

void TrackTable::clear_evidence() {
  for (RestingObject& row : rows_) {
    row.is_seen = false;
    row.look.reset();
    row.is_in_doubt = false;
    row.detection_probability = 0.0;
  }
}

}  // namespace geoloc
