// SPDX-License-Identifier: Apache-2.0
#include "common/ignored_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace geoloc::apps {
namespace {

/// `mavlink.camera` of the JSON pointer `/mavlink/camera`.
std::string setting_of(std::string pointer) {
  pointer.erase(0, 1);
  std::replace(pointer.begin(), pointer.end(), '/', '.');
  return pointer;
}

bool is_within(const std::string& setting, const std::string& path) {
  return setting == path || setting.rfind(path + ".", 0) == 0;
}

/// The first three by name.
std::string list_of(const std::vector<std::string>& settings) {
  constexpr std::size_t kMostNamed = 3;
  std::string list;
  for (std::size_t i = 0; i < std::min(settings.size(), kMostNamed); ++i)
    list += (i == 0 ? "" : ", ") + settings[i];
  return settings.size() > kMostNamed ? fmt::format("{} and {} more", list, settings.size() - kMostNamed)
                                      : list;
}

const char* reason_for(const std::string& setting, const std::vector<Ignored>& ignored) {
  for (const Ignored& entry : ignored) {
    if (is_within(setting, entry.path)) return entry.reason;
  }
  return nullptr;
}

}  // namespace

std::vector<Ignored> ignored_by(const EstimationConfig& config, const OutputOptions& outputs) {
  std::vector<Ignored> ignored;
  if (config.geolocator.method == Method::kJoint) ignored.push_back({"paper", "the method is joint"});
  if (config.geolocator.method == Method::kPaper) ignored.push_back({"joint", "the method is paper"});
  if (outputs.http.empty()) ignored.push_back({"live_page", "there is no --http"});
  if (outputs.cot.empty()) ignored.push_back({"cot", "there is no --cot"});
  return ignored;
}

std::vector<std::string> ignored_settings(const nlohmann::json& document, const nlohmann::json& before,
                                          const std::vector<Ignored>& ignored, const std::string& name) {
  if (!document.is_object()) return {};
  const nlohmann::json values = document.flatten(), old_values = before.flatten();
  std::vector<std::pair<const char*, std::vector<std::string>>> by_reason;
  for (const auto& [pointer, value] : values.items()) {
    const char* const reason = reason_for(setting_of(pointer), ignored);
    const auto old_value = old_values.find(pointer);
    if (reason == nullptr || (old_value != old_values.end() && *old_value == value)) continue;
    auto group = std::find_if(by_reason.begin(), by_reason.end(),
                              [reason](const auto& entry) { return entry.first == reason; });
    if (group == by_reason.end()) group = by_reason.insert(by_reason.end(), {reason, {}});
    group->second.push_back(setting_of(pointer));
  }
  std::vector<std::string> lines;
  for (const auto& [reason, settings] : by_reason)
    lines.push_back(fmt::format("{}: without effect here, since {}: {}", name, reason, list_of(settings)));
  return lines;
}

}  // namespace geoloc::apps
