// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace geoloc::io {

/// Drops every second entry, so that the rest covers the same time.
template <typename T>
void thin_out(std::vector<T>& entries) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < entries.size(); i += 2) entries[kept++] = entries[i];
  entries.erase(entries.begin() + static_cast<std::ptrdiff_t>(kept), entries.end());
}

}  // namespace geoloc::io
