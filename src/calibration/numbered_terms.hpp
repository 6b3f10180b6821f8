// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace geoloc {

/// Up to kMost terms in order of their `number`, in place. Never allocates.
template <typename Terms, std::size_t kMost>
class NumberedTerms {
 public:
  const Terms* begin() const { return terms_.data(); }
  const Terms* end() const { return terms_.data() + count_; }
  Terms* begin() { return terms_.data(); }
  Terms* end() { return terms_.data() + count_; }
  bool is_empty() const { return count_ == 0; }
  void clear() { count_ = 0; }
  bool is_full() const { return count_ == kMost; }

  /// nullptr: there is none of that number. It is looked for among the last ones first, where those are that
  /// are in use.
  Terms* find(std::uint32_t number) {
    for (Terms* last = end(); last != begin() && end() - last < 2;) {
      if ((--last)->number == number) return last;
    }
    Terms* const place = place_of(number);
    return place != end() && place->number == number ? place : nullptr;
  }

  /// Empty terms of a number that there are none of yet. There must be room.
  Terms& insert(std::uint32_t number) {
    Terms* const place = place_of(number);
    std::move_backward(place, end(), end() + 1);
    ++count_;
    *place = Terms{};
    place->number = number;
    return *place;
  }

  void erase(Terms* place) {
    std::move(place + 1, end(), place);
    --count_;
  }

 private:
  Terms* place_of(std::uint32_t number) {
    return std::lower_bound(begin(), end(), number,
                            [](const Terms& terms, std::uint32_t sought) { return terms.number < sought; });
  }

  std::array<Terms, kMost> terms_{};
  std::size_t count_ = 0;
};

}  // namespace geoloc
