// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

// What geoloc_import tells on stderr.
namespace geoloc::apps {

inline void tell(const std::string& line) {
  std::fprintf(stderr, "geoloc_import: %s\n", line.c_str());
}

/// The first ones; folders may hold thousands.
inline void tell_left_out(const std::vector<std::string>& left_out) {
  constexpr std::size_t kMostTold = 10;
  for (std::size_t i = 0; i < std::min(left_out.size(), kMostTold); ++i) tell("left out: " + left_out[i]);
  if (left_out.size() > kMostTold) tell("left out: " + std::to_string(left_out.size() - kMostTold) + " more");
}

inline void tell_plan(const std::vector<std::string>& notes, const std::vector<std::string>& assumptions) {
  for (const std::string& note : notes) tell(note);
  for (const std::string& assumption : assumptions) tell("assumed: " + assumption);
}

}  // namespace geoloc::apps
