// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "geoloc/geometry/time.hpp"

// Members of a summary as JSON. What reads them throws std::runtime_error that says what is wrong with which.
namespace geoloc::io {

using nlohmann::json;
using nlohmann::ordered_json;

inline ordered_json row_to_json(const Eigen::Ref<const Eigen::RowVectorXd>& row) {
  auto numbers = ordered_json::array();
  for (Eigen::Index i = 0; i < row.size(); ++i) numbers.push_back(row[i]);
  return numbers;
}

/// A member that must be there; a std::runtime_error names it.
inline const json& member(const json& object, const char* key) {
  if (!object.is_object()) throw std::runtime_error("must be an object");
  const auto found = object.find(key);
  if (found == object.end()) throw std::runtime_error(std::string(key) + " is missing");
  return *found;
}

inline double number(const json& value, const char* what) {
  if (!value.is_number()) throw std::runtime_error(std::string(what) + " must be a number");
  return value.get<double>();
}

template <typename Whole>
Whole whole(const json& value, const char* what) {
  const bool fits =
      value.is_number_unsigned()
          ? value.get<std::uint64_t>() <= static_cast<std::uint64_t>(std::numeric_limits<Whole>::max())
          : std::is_signed_v<Whole> && value.is_number_integer() &&
                value.get<std::int64_t>() >= static_cast<std::int64_t>(std::numeric_limits<Whole>::min());
  if (!fits) throw std::runtime_error(std::string(what) + " must be a whole number in its range");
  return value.get<Whole>();
}

inline std::string text(const json& value, const char* what) {
  if (!value.is_string()) throw std::runtime_error(std::string(what) + " must be a text");
  return value.get<std::string>();
}

inline const json& list(const json& value, std::size_t size, const char* what) {
  if (!value.is_array() || value.size() != size)
    throw std::runtime_error(std::string(what) + " must be a list of " + std::to_string(size));
  return value;
}

/// A member in nanoseconds.
template <typename Time>
Time time(const json& object, const char* key) {
  return Time{Duration{whole<std::int64_t>(member(object, key), key)}};
}

}  // namespace geoloc::io
