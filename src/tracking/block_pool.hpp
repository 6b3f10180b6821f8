// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/room.hpp"

namespace geoloc {

/// Numbered places for values that come and go. They are allocated in blocks, as they become more, and don't
/// move.
template <typename T, std::size_t kBlock = 256>
class BlockPool {
 public:
  T& operator[](std::uint32_t place) { return blocks_[place / kBlock][place % kBlock]; }
  const T& operator[](std::uint32_t place) const { return blocks_[place / kBlock][place % kBlock]; }

  /// One past the highest place that was ever in use.
  std::uint32_t end() const { return end_; }

  /// geometry/room.hpp
  static std::size_t take_room(BlockPool* self, std::size_t count) {
    const std::size_t blocks = (count + kBlock - 1) / kBlock;
    const std::size_t bytes = room::reserve(self, &BlockPool::blocks_, blocks) +
                              room::reserve(self, &BlockPool::free_, blocks * kBlock) +
                              blocks * room::bytes_of_array<T>(kBlock);
    if (self != nullptr) self->reserve(count);
    return bytes;
  }

  /// Room for so many.
  void reserve(std::size_t count) {
    while (blocks_.size() * kBlock < count) {
      blocks_.push_back(std::make_unique<T[]>(kBlock));
      free_.reserve(blocks_.capacity() * kBlock);
    }
  }

  /// A place whose value is as it was left.
  std::uint32_t take() {
    if (!free_.empty()) {
      const std::uint32_t place = free_.back();
      free_.pop_back();
      return place;
    }
    reserve(end_ + std::size_t{1});
    return end_++;
  }

  void give_back(std::uint32_t place) { free_.push_back(place); }

 private:
  std::vector<std::unique_ptr<T[]>> blocks_;
  std::vector<std::uint32_t> free_;
  std::uint32_t end_ = 0;
};

}  // namespace geoloc
