// SPDX-License-Identifier: Apache-2.0
#include "support/source_tree.hpp"

namespace geoloc {

std::filesystem::path source_tree() {
  return GEOLOC_SOURCE_DIR;
}

std::filesystem::path test_data() {
  return source_tree() / "tests/data";
}

}  // namespace geoloc
