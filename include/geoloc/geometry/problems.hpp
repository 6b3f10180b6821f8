// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
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

/// Throws std::invalid_argument that names all of them, unless there are none.
inline void throw_if_any(const std::vector<std::string>& problems) {
  if (problems.empty()) return;
  std::string all;
  for (const std::string& problem : problems) all += (all.empty() ? "" : "; ") + problem;
  throw std::invalid_argument(all);
}

}  // namespace geoloc
