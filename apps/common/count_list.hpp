// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>

namespace geoloc::apps {

/// "HEADING: 3 of this, 1 of that": those counts that are not 0, each with what it counts. Empty where all
/// are 0.
inline std::string list_of_counts(const std::string& heading,
                                  std::initializer_list<std::pair<std::uint64_t, const char*>> counts) {
  std::string list;
  for (const auto& [count, what] : counts) {
    if (count > 0) list += (list.empty() ? heading + ": " : ", ") + std::to_string(count) + " " + what;
  }
  return list;
}

}  // namespace geoloc::apps
