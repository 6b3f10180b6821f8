// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "settings/rules.hpp"

namespace geoloc::io {

/// Builds the JSON object that FieldReader accepts back.
class FieldWriter {
 public:
  template <typename T, typename Rule>
  void field(const char* key, const T& value, const Rule& /*rule*/, const char* /*unit*/,
             const char* /*meaning*/) {
    object_[key] = to_json_value(value);
  }

  template <typename T>
  void section(const char* key, T& value) {
    object_[key] = to_object(value);
  }

  template <typename T>
  void list(const char* key, std::vector<T>& values, const char* /*meaning*/) {
    auto& array = object_[key] = nlohmann::ordered_json::array();
    for (T& value : values) array.push_back(to_object(value));
  }

  void relation(const char* /*key*/, double /*value*/, bool /*holds*/, const char* /*demand*/) {}

  nlohmann::ordered_json take() { return std::move(object_); }

  template <typename T>
  static nlohmann::ordered_json to_json_value(const T& value) {
    if constexpr (std::is_enum_v<T>) {
      return name_of(value);
    } else {
      return value;
    }
  }

 private:
  template <typename T>
  static nlohmann::ordered_json to_object(T& value) {
    FieldWriter inner;
    visit_fields(inner, value);
    return inner.take();
  }

  nlohmann::ordered_json object_ = nlohmann::ordered_json::object();
};

/// A structure that visit_fields() describes, with every present value.
template <typename Config>
nlohmann::ordered_json fields_to_json(Config config) {  // by value: the visit takes what it may change
  FieldWriter writer;
  visit_fields(writer, config);
  return writer.take();
}

}  // namespace geoloc::io
