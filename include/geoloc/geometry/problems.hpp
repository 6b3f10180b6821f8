// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace geoloc {

/// Gathers every fault of a configuration, so that a user mends them in one go.
class Problems {
 public:
  void require(bool holds, const char* message) {
    if (!holds) found_.emplace_back(message);
  }
  void add(const std::vector<std::string>& others) {
    found_.insert(found_.end(), others.begin(), others.end());
  }
  std::vector<std::string> take() { return std::move(found_); }

 private:
  std::vector<std::string> found_;
};

}  // namespace geoloc
