// SPDX-License-Identifier: Apache-2.0
#include "tracking/track_table.hpp"

#include <algorithm>

#include "geometry/room.hpp"

namespace geoloc {

TrackTable::TrackTable(int max_tracks) : max_tracks_(max_tracks) {
  take_room(this, max_tracks_);
}

std::size_t TrackTable::take_room(TrackTable* self, std::size_t max_tracks) {
  const std::size_t blocks = (std::min(max_tracks, kRowsAtFirst) + kEntriesAtOnce - 1) / kEntriesAtOnce;
  const std::size_t bytes = room::reserve(self, &TrackTable::rows_, max_tracks) +
                            room::reserve(self, &TrackTable::free_entries_, max_tracks + kEntriesAtOnce) +
                            room::reserve(self, &TrackTable::landmarks_of_rows_, max_tracks) +
                            room::reserve(self, &TrackTable::entries_, blocks);
  for (std::size_t i = 0; self != nullptr && i < blocks; ++i) self->add_entries();
  return bytes + blocks * room::bytes_of_array<Entry>(kEntriesAtOnce);
}

void TrackTable::add_entries() {
  entries_.push_back(std::make_unique<Entry[]>(kEntriesAtOnce));
  for (std::size_t i = kEntriesAtOnce; i-- > 0;) {
    Entry& entry = entries_.back()[i];
    entry.object.landmark = &entry.landmark;
    free_entries_.push_back(&entry.object);
  }
}

const std::vector<const Landmark*>& TrackTable::landmarks() {
  landmarks_of_rows_.clear();
  for (const RestingObject* row : rows_) landmarks_of_rows_.push_back(row->landmark);
  return landmarks_of_rows_;
}

std::vector<RestingObject*>::iterator TrackTable::place_of(std::uint64_t track_id) {
  const auto is_before = [](const RestingObject* row, std::uint64_t id) { return row->track.id < id; };
  return std::lower_bound(rows_.begin(), rows_.end(), track_id, is_before);
}

RestingObject* TrackTable::find(std::uint64_t track_id) {
  const auto row = place_of(track_id);
  return row != rows_.end() && (*row)->track.id == track_id ? *row : nullptr;
}

RestingObject* TrackTable::take_entry() {
  if (free_entries_.empty()) add_entries();
  RestingObject* const taken = free_entries_.back();
  free_entries_.pop_back();
  Landmark* const landmark = taken->landmark;
  *taken = RestingObject{};
  taken->landmark = landmark;
  return taken;
}

RestingObject& TrackTable::append() {
  rows_.push_back(take_entry());
  return *rows_.back();
}

RestingObject& TrackTable::insert(std::uint64_t track_id) {
  RestingObject* const row = take_entry();
  row->track.id = track_id;
  rows_.insert(place_of(track_id), row);
  return *row;
}

void TrackTable::remove(std::size_t row) {
  free_entries_.push_back(rows_[row]);
  rows_.erase(rows_.begin() + static_cast<std::ptrdiff_t>(row));
}

void TrackTable::clear_evidence() {
  for (RestingObject* row : rows_) {
    row->is_seen = false;
    row->look.reset();
    row->is_in_doubt = false;
    row->detection_probability = 0.0;
  }
}

}  // namespace geoloc
