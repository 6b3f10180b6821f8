// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace geoloc::io {

/// Throws std::runtime_error that names the file and every problem.
[[noreturn]] inline void refuse_camera(const std::string& name, const std::vector<std::string>& problems) {
  std::string all;
  for (const std::string& problem : problems) all += "\n  " + problem;
  throw std::runtime_error(name + ": not a usable camera calibration:" + all);
}

}  // namespace geoloc::io
