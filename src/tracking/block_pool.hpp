// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

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
