// SPDX-License-Identifier: Apache-2.0
#include "eval/setting_sweep.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace geoloc::apps {
namespace {

constexpr double kLargestWhole = 1e15;  // beyond it doubles are not all whole numbers

[[noreturn]] void refuse(const std::string& text, const std::string& reason) {
  throw std::runtime_error("--sweep-setting " + text + ": " + reason);
}

nlohmann::json::json_pointer pointer_of(std::string path) {
  std::replace(path.begin(), path.end(), '.', '/');
  return nlohmann::json::json_pointer("/" + path);
}

std::vector<double> values_of(const std::string& list, const std::string& text) {
  std::vector<double> values;
  std::istringstream stream(list);
  for (std::string item; std::getline(stream, item, ',');) {
    double value = 0.0;
    const char* const end = item.data() + item.size();
    const auto parsed = std::from_chars(item.data(), end, value);
    if (parsed.ec != std::errc{} || parsed.ptr != end || !std::isfinite(value))
      refuse(text, "'" + item + "' is no number");
    values.push_back(value);
  }
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  if (values.empty()) refuse(text, "it needs PATH=VALUE,VALUE");
  return values;
}

/// The setting at a value; what is refused is added to the problems.
void apply(const std::string& path, double value, EstimationConfig& config,
           std::vector<std::string>& problems) {
  nlohmann::json document = nlohmann::json::object();
  const bool is_whole = std::abs(value) < kLargestWhole && value == std::floor(value);
  document[pointer_of(path)] =
      is_whole ? nlohmann::json(static_cast<std::int64_t>(value)) : nlohmann::json(value);
  estimation_from_json(document, {}, config, problems);
}

/// Over more than a decade.
bool is_wide(const std::vector<double>& values) {
  return values.front() > 0.0 && values.back() >= 10.0 * values.front();
}

}  // namespace

Sweep setting_sweep(const std::string& text, const EstimationConfig& config) {
  const auto equals = text.find('=');
  if (equals == std::string::npos) refuse(text, "it needs PATH=VALUE,VALUE");
  const std::string path = text.substr(0, equals);
  const nlohmann::json settings = estimation_to_json(config);
  if (path.empty() || path.find_first_of("/~") != std::string::npos || !settings.contains(pointer_of(path)))
    refuse(text, "there is no setting '" + path + "'; geoloc_app --print-settings lists them");
  const nlohmann::json& usual = settings[pointer_of(path)];
  if (!usual.is_number()) refuse(text, "only settings that are numbers can be varied");
  if (path.rfind("live_page.", 0) == 0 || path.rfind("cot.", 0) == 0 || path.rfind("camera.", 0) == 0)
    refuse(text, "an evaluation does not use this setting");

  Sweep sweep;
  sweep.name = path;
  sweep.title = path;
  sweep.axis = path;
  sweep.values = values_of(text.substr(equals + 1), text);
  sweep.is_logarithmic = is_wide(sweep.values);
  sweep.usual = usual.get<double>();
  sweep.configure = [path](double value, EstimationConfig& its_config) {
    std::vector<std::string> problems;
    apply(path, value, its_config, problems);
  };
  std::vector<std::string> problems;
  for (const double value : sweep.values) {
    EstimationConfig tried = config;
    apply(path, value, tried, problems);
  }
  std::string all;
  for (const std::string& problem : problems) all += "\n  " + problem;
  if (!all.empty()) refuse(text, "unusable values:" + all);
  return sweep;
}

}  // namespace geoloc::apps
