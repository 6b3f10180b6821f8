// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

// Values of JSON that others wrote; each throws std::invalid_argument naming `what` and the fault.
namespace geoloc::io {

inline double finite_number(const nlohmann::json& value, const char* what) {
  if (!value.is_number() || !std::isfinite(value.get<double>())) {
    throw std::invalid_argument(std::string(what) + " must be a finite number");
  }
  return value.get<double>();
}

inline int whole_number(const nlohmann::json& value, const char* what, double below) {
  const double number = finite_number(value, what);
  if (!(number >= 0.0 && number < below && number == std::floor(number))) {
    throw std::invalid_argument(std::string(what) + " must be a whole number from 0");
  }
  return static_cast<int>(number);
}

inline const nlohmann::json& member(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end()) throw std::invalid_argument(std::string(key) + " is missing");
  return *found;
}

}  // namespace geoloc::io
