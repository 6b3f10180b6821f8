// SPDX-License-Identifier: Apache-2.0
#include "tracking/place_index.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/room.hpp"

namespace geoloc {
namespace {

constexpr std::size_t kFirstBuckets = 8192;
/// Cells hold many places each where places are dense, so that there may be fewer lists than places.
constexpr std::size_t kPlacesPerBucket = 16;
/// Cells farther out are counted to the last one.
constexpr double kLastCell = 1e9;

}  // namespace

PlaceIndex::PlaceIndex(double cell_m, std::size_t keys) : cell_m_(cell_m) {
  take_room(this, keys);
  std::fill(heads_.begin(), heads_.end(), kNone);
}

std::size_t PlaceIndex::take_room(PlaceIndex* self, std::size_t keys) {
  return room::resize(self, &PlaceIndex::heads_, kFirstBuckets) +
         room::resize(self, &PlaceIndex::links_, keys);
}

PlaceIndex::Cell PlaceIndex::cell_of(const Eigen::Vector2d& place) const {
  const auto coordinate = [&](double along_m) {
    return static_cast<std::int32_t>(std::floor(std::clamp(along_m / cell_m_, -kLastCell, kLastCell)));
  };
  return {coordinate(place.x()), coordinate(place.y())};
}

/// Two odd multipliers, mixed by the upper half of a product (Fibonacci hashing, Knuth 6.4).
std::size_t PlaceIndex::bucket_of(const Cell& cell) const {
  const std::uint64_t mixed = static_cast<std::uint32_t>(cell.east) * 0x9E3779B97F4A7C15u ^
                              static_cast<std::uint32_t>(cell.north) * 0xC2B2AE3D27D4EB4Fu;
  return static_cast<std::size_t>((mixed ^ mixed >> 32) * 0x9E3779B97F4A7C15u >> 32) & (heads_.size() - 1);
}

void PlaceIndex::reserve(std::size_t count) {
  if (count <= links_.size()) return;
  links_.resize(std::max(count, links_.size() + links_.size() / 2));
  while (links_.size() > kPlacesPerBucket * heads_.size()) double_buckets();
}

void PlaceIndex::insert(std::uint32_t key, const Eigen::Vector2d& place) {
  reserve(key + std::size_t{1});
  ++size_;
  links_[key].cell = cell_of(place);
  link(key);
}

void PlaceIndex::link(std::uint32_t key) {
  std::uint32_t& head = heads_[bucket_of(links_[key].cell)];
  links_[key].before = kNone;
  links_[key].after = head;
  if (head != kNone) links_[head].before = key;
  head = key;
}

void PlaceIndex::erase(std::uint32_t key) {
  const Link& gone = links_[key];
  if (gone.before == kNone) {
    heads_[bucket_of(gone.cell)] = gone.after;
  } else {
    links_[gone.before].after = gone.after;
  }
  if (gone.after != kNone) links_[gone.after].before = gone.before;
  --size_;
}

void PlaceIndex::move(std::uint32_t key, const Eigen::Vector2d& place) {
  if (cell_of(place) == links_[key].cell) return;
  erase(key);
  insert(key, place);
}

/// The lists are made anew.
void PlaceIndex::double_buckets() {
  const std::vector<std::uint32_t> before = std::exchange(heads_, std::vector(2 * heads_.size(), kNone));
  for (const std::uint32_t head : before) {
    for (std::uint32_t key = head; key != kNone;) {
      const std::uint32_t next = links_[key].after;
      link(key);
      key = next;
    }
  }
}

}  // namespace geoloc
