// SPDX-License-Identifier: Apache-2.0
#include "geoloc/geometry/refuse.hpp"

#include <cstdio>
#include <cstdlib>
#include <stdexcept>

namespace geoloc {

void refuse(const std::string& reason) {
#if defined(__cpp_exceptions)
  throw std::invalid_argument(reason);
#else
  std::fprintf(stderr, "geoloc: %s\n", reason.c_str());
  std::abort();
#endif
}

void refuse_if_any(const std::vector<std::string>& problems) {
  if (problems.empty()) return;
  std::string all;
  for (const std::string& problem : problems) all += (all.empty() ? "" : "; ") + problem;
  refuse(all);
}

}  // namespace geoloc
