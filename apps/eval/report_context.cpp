// SPDX-License-Identifier: Apache-2.0
#include "eval/report_context.hpp"

#include <algorithm>

namespace geoloc::apps {
namespace {

/// In single quotes, where a shell would take it for anything but a word.
std::string quoted(const std::string& argument) {
  constexpr const char* kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_=+,./:@%";
  if (!argument.empty() && argument.find_first_not_of(kPlain) == std::string::npos) return argument;
  std::string text = "'";
  for (const char character : argument) text += character == '\'' ? "'\\''" : std::string(1, character);
  return text + "'";
}

}  // namespace

std::string command_of(int argc, const char* const* argv) {
  std::string command;
  for (int i = 0; i < argc; ++i) command += (i == 0 ? "" : " ") + quoted(argv[i]);
  return command;
}

std::vector<std::string> changed_settings(const EstimationConfig& config) {
  const EstimationConfig usual_config;
  const nlohmann::json defaults = nlohmann::json(estimation_to_json(usual_config)).flatten();
  const nlohmann::json values = nlohmann::json(estimation_to_json(config)).flatten();
  std::vector<std::string> changed;
  for (const auto& [pointer, value] : values.items()) {
    if (const auto usual = defaults.find(pointer); usual != defaults.end() && *usual == value) continue;
    std::string path = pointer.substr(1);
    std::replace(path.begin(), path.end(), '/', '.');
    changed.push_back(path + " = " + value.dump());
  }
  return changed;
}

}  // namespace geoloc::apps
