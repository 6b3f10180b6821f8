// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>
#include <string>

namespace geoloc::testing {

/// Pieces overwritten, removed and repeated.
inline std::string spoilt(std::string bytes, std::mt19937& random) {
  for (int left = 1 + static_cast<int>(random() % 6); left > 0 && !bytes.empty(); --left) {
    const std::size_t at = random() % bytes.size();
    const std::size_t length = 1 + random() % 40;
    switch (random() % 3) {
      case 0:
        bytes[at] = static_cast<char>(random());
        break;
      case 1:
        bytes.erase(at, length);
        break;
      default:
        bytes.insert(random() % bytes.size(), bytes.substr(at, length));
    }
  }
  return bytes;
}

}  // namespace geoloc::testing
