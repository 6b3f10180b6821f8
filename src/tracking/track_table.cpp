// SPDX-License-Identifier: Apache-2.0
#include "tracking/track_table.hpp"

namespace geoloc {

TrackTable::TrackTable(int max_tracks) : max_tracks_(max_tracks) {
  rows_.reserve(max_tracks_);
  landmarks_.reserve(max_tracks_);
  free_landmarks_.reserve(max_tracks_);
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
