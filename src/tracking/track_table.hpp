// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "calibration/landmark.hpp"
#include "tracking/resting_object.hpp"

namespace geoloc {

/// The objects at rest, in order of their ids. Never allocates after construction.
class TrackTable {
 public:
  explicit TrackTable(int max_tracks);
  TrackTable(const TrackTable&) = delete;
  TrackTable& operator=(const TrackTable&) = delete;

  std::size_t size() const { return rows_.size(); }
  bool is_full() const { return rows_.size() == max_tracks_; }
  RestingObject& operator[](std::size_t row) { return rows_[row]; }
  const RestingObject& operator[](std::size_t row) const { return rows_[row]; }
  auto begin() { return rows_.begin(); }
  auto end() { return rows_.end(); }
  auto begin() const { return rows_.begin(); }
  auto end() const { return rows_.end(); }

  /// Those of all rows. The reference holds until the next call.
  const std::vector<const Landmark*>& landmarks();

  /// The row of an object; nullptr: there is none.
  RestingObject* find(std::uint64_t track_id);

  /// A row at the end; its landmark is the caller's to begin. Only where the table is not full.
  RestingObject& append();
  void remove(std::size_t row);

  /// Nothing is known of the next frame yet.
  void clear_evidence();

 private:
  std::size_t max_tracks_;
  std::vector<RestingObject> rows_;
  std::vector<Landmark> landmarks_;  // their places are reused
  std::vector<Landmark*> free_landmarks_;
  std::vector<const Landmark*> landmarks_of_rows_;  // scratch
};

}  // namespace geoloc
