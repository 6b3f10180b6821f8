// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace geoloc {

/// The first faults of a value from elsewhere, each after the name of the part that has it.
class NamedFaults {
 public:
  /// What follows is of that part.
  void enter(std::string part) { part_ = std::move(part); }

  void require(bool holds, const char* demand) {
    if (!holds && found_.size() < kMost) found_.push_back(part_ + demand);
  }

  std::vector<std::string> take() { return std::move(found_); }

 private:
  static constexpr std::size_t kMost = 10;
  std::string part_;
  std::vector<std::string> found_;
};

}  // namespace geoloc
