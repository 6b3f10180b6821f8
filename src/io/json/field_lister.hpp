// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "io/json/field_writer.hpp"
#include "settings/rules.hpp"

namespace geoloc::io {

/// What there is to say of a setting.
struct FieldLine {
  std::string path;           ///< "joint.gate"; the entries of a list are called "known_points[]"
  std::string default_value;  ///< JSON
  std::string range;          ///< empty where anything goes
  std::string unit;           ///< empty: none
  std::string meaning;
};

/// Lists the settings of a structure that visit_fields() describes; given one with its defaults.
class FieldLister {
 public:
  explicit FieldLister(std::vector<FieldLine>& lines, std::string path = {})
      : lines_(lines), path_(std::move(path)) {}

  template <typename T, typename Rule>
  void field(const char* key, const T& value, const Rule& rule, const char* unit, const char* meaning) {
    lines_.push_back(
        {path_of(key), FieldWriter::to_json_value(value).dump(), allowed<T>(rule), unit, meaning});
  }

  template <typename T>
  void section(const char* key, T& value) {
    FieldLister inner(lines_, path_of(key));
    visit_fields(inner, value);
  }

  template <typename T>
  void list(const char* key, std::vector<T>& /*values*/, const char* meaning) {
    lines_.push_back({path_of(key), "[]", "", "", meaning});
    T entry{};
    section((std::string(key) + "[]").c_str(), entry);
  }

  void relation(const char* /*key*/, double /*value*/, bool /*holds*/, const char* /*demand*/) {}

 private:
  std::string path_of(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }

  std::vector<FieldLine>& lines_;
  std::string path_;
};

}  // namespace geoloc::io
