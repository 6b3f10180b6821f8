// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "calibration/landmark.hpp"
#include "tracking/resting_object.hpp"

namespace geoloc {

/// The objects at rest that frames may show, in order of their ids. Rows don't move in memory. Allocates
/// where more rows are in use than ever before, and than kRowsAtFirst.
class TrackTable {
 public:
  /// Goes through the rows as if they lay one behind the other.
  template <typename Row>
  class Iterator {
   public:
    explicit Iterator(RestingObject* const* row) : row_(row) {}
    Row& operator*() const { return **row_; }
    Iterator& operator++() {
      ++row_;
      return *this;
    }
    bool operator!=(const Iterator& other) const { return row_ != other.row_; }

   private:
    RestingObject* const* row_;
  };

  static constexpr std::size_t kRowsAtFirst = 64;

  explicit TrackTable(int max_tracks);
  /// geometry/room.hpp
  static std::size_t take_room(TrackTable* self, std::size_t max_tracks);
  TrackTable(const TrackTable&) = delete;
  TrackTable& operator=(const TrackTable&) = delete;

  std::size_t size() const { return rows_.size(); }
  bool is_full() const { return rows_.size() == max_tracks_; }
  RestingObject& operator[](std::size_t row) { return *rows_[row]; }
  const RestingObject& operator[](std::size_t row) const { return *rows_[row]; }
  auto begin() { return Iterator<RestingObject>(rows_.data()); }
  auto end() { return Iterator<RestingObject>(rows_.data() + rows_.size()); }
  auto begin() const { return Iterator<const RestingObject>(rows_.data()); }
  auto end() const { return Iterator<const RestingObject>(rows_.data() + rows_.size()); }

  /// Those of all rows. The reference holds until the next call.
  const std::vector<const Landmark*>& landmarks();

  /// The row of an object; nullptr: there is none.
  RestingObject* find(std::uint64_t track_id);

  /// A new row at the end; its landmark is the caller's to begin. Only where the table is not full.
  RestingObject& append();
  /// The same at its place in the order; there is no row of that id yet.
  RestingObject& insert(std::uint64_t track_id);
  void remove(std::size_t row);

  /// Nothing is known of the next frame yet.
  void clear_evidence();

 private:
  struct Entry {
    RestingObject object;
    Landmark landmark;
  };
  static constexpr std::size_t kEntriesAtOnce = 32;

  void add_entries();
  RestingObject* take_entry();
  std::vector<RestingObject*>::iterator place_of(std::uint64_t track_id);

  std::size_t max_tracks_;
  std::vector<RestingObject*> rows_;
  std::vector<std::unique_ptr<Entry[]>> entries_;
  std::vector<RestingObject*> free_entries_;
  std::vector<const Landmark*> landmarks_of_rows_;  // scratch
};

}  // namespace geoloc
