// SPDX-License-Identifier: Apache-2.0
#include "io/json/field_reader.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace geoloc::io {
namespace {

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string FieldReader::suggestion(const std::string& key) const {
  constexpr std::size_t kLongest = 64;  // a hostile key is not worth comparing
  std::string best;
  std::size_t best_distance = 4;
  for (const std::string& candidate : known_) {
    const std::size_t distance = key.size() > kLongest ? kLongest : edit_distance(key, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  if (!best.empty()) return "did you mean " + best + "?";
  return "--print-config shows them all";
}

void FieldReader::refuse_unknown() {
  if (!object_.is_object()) return;
  for (const auto& [key, ignored] : object_.items()) {
    if (std::find(known_.begin(), known_.end(), key) == known_.end())
      problems_.push_back(path_of(key) + " is not a setting; " + suggestion(key));
  }
}

void FieldReader::refuse(const std::string& path, const std::string& demand, const nlohmann::json& value) {
  constexpr std::size_t kShown = 60;  // a hostile value may be long
  const std::string text = value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  problems_.push_back(path + " " + demand + ", but is " + text.substr(0, kShown) +
                      (text.size() > kShown ? "…" : ""));
}

void FieldReader::read(const nlohmann::json& json, const std::string& path, double& value) {
  // JSON has no NaN, but 1e999 parses to infinity.
  if (json.is_number() && std::isfinite(json.get<double>())) {
    value = json.get<double>();
  } else {
    refuse(path, "must be a finite number", json);
  }
}

void FieldReader::read(const nlohmann::json& json, const std::string& path, int& value) {
  constexpr double kLargest = std::numeric_limits<int>::max();
  if (json.is_number_integer() && std::abs(json.get<double>()) <= kLargest) {
    value = json.get<int>();
  } else {
    refuse(path, "must be a whole number", json);
  }
}

void FieldReader::read(const nlohmann::json& json, const std::string& path, bool& value) {
  if (json.is_boolean()) {
    value = json.get<bool>();
  } else {
    refuse(path, "must be true or false", json);
  }
}

void FieldReader::read(const nlohmann::json& json, const std::string& path, std::string& value) {
  if (json.is_string()) {
    value = json.get<std::string>();
  } else {
    refuse(path, "must be a text", json);
  }
}

void FieldReader::read(const nlohmann::json& json, const std::string& path,
                       std::map<std::string, std::string>& value) {
  if (!json.is_object()) return refuse(path, "must be an object of texts", json);
  value.clear();
  for (const auto& [key, entry] : json.items()) read(entry, path + "." + key, value[key]);
}

}  // namespace geoloc::io
