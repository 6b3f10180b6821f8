// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace geoloc::apps {

/// One file to look at.
struct DetectInput {
  std::filesystem::path file;
  bool is_video = false;
};

/// The files given, and of each folder given its pictures, by name. Throws std::runtime_error naming what
/// does not exist and folders without a picture.
std::vector<DetectInput> find_inputs(const std::vector<std::string>& given);

}  // namespace geoloc::apps
