// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace geoloc {

/// Which of many places lie in an area: a grid of cells, hashed. Places come, go and move one by one, and
/// each costs the same however many there are. Allocates as they become more.
class PlaceIndex {
 public:
  /// With room for the keys below `keys`.
  explicit PlaceIndex(double cell_m, std::size_t keys = 0);
  /// geometry/room.hpp
  static std::size_t take_room(PlaceIndex* self, std::size_t keys);

  std::size_t size() const { return size_; }

  /// Room for the keys below `count`.
  void reserve(std::size_t count);

  /// Keys are small: places in a table.
  void insert(std::uint32_t key, const Eigen::Vector2d& place);
  void erase(std::uint32_t key);
  /// It is elsewhere now.
  void move(std::uint32_t key, const Eigen::Vector2d& place);

  /// Calls visit(key) for each key whose cell touches the area, and perhaps for some outside. The index must
  /// not change meanwhile.
  template <typename Visit>
  void for_each_near(const Eigen::AlignedBox2d& area, const Visit& visit) const {
    const Cell first = cell_of(area.min()), last = cell_of(area.max());
    const double cells = (static_cast<double>(last.east) - first.east + 1.0) *
                         (static_cast<double>(last.north) - first.north + 1.0);
    if (cells > static_cast<double>(heads_.size())) return for_each(visit);
    for (std::int32_t east = first.east; east <= last.east; ++east) {
      for (std::int32_t north = first.north; north <= last.north; ++north) for_each_in({east, north}, visit);
    }
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  struct Cell {
    std::int32_t east = 0;
    std::int32_t north = 0;
    bool operator==(const Cell& other) const { return east == other.east && north == other.north; }
  };
  /// A key in the list of those whose cells have one hash.
  struct Link {
    Cell cell;
    std::uint32_t before = kNone;
    std::uint32_t after = kNone;
  };

  template <typename Visit>
  void for_each_in(const Cell& cell, const Visit& visit) const {
    for (std::uint32_t key = heads_[bucket_of(cell)]; key != kNone; key = links_[key].after) {
      if (links_[key].cell == cell) visit(key);
    }
  }

  template <typename Visit>
  void for_each(const Visit& visit) const {
    for (const std::uint32_t head : heads_) {
      for (std::uint32_t key = head; key != kNone; key = links_[key].after) visit(key);
    }
  }

  Cell cell_of(const Eigen::Vector2d& place) const;
  std::size_t bucket_of(const Cell& cell) const;
  void link(std::uint32_t key);
  void double_buckets();

  double cell_m_;
  std::vector<std::uint32_t> heads_;  // of the lists; their number is a power of two
  std::vector<Link> links_;           // by key
  std::size_t size_ = 0;
};

}  // namespace geoloc
