// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "settings/rules.hpp"

namespace geoloc {

/// Adds a problem for each setting whose value its description does not allow, with the setting's path, what
/// it must be, and the value met: "joint.gate must lie in (0, 1000], but is -1".
class FieldChecker {
 public:
  /// `path` precedes the names of the settings.
  explicit FieldChecker(std::vector<std::string>& problems, std::string path = {})
      : problems_(problems), path_(std::move(path)) {}

  template <typename T, typename Rule>
  void field(const char* key, const T& value, const Rule& rule, const char* /*unit*/,
             const char* /*meaning*/) {
    check(path_of(key), value, rule);
  }

  template <typename T>
  void section(const char* key, T& value) {
    FieldChecker inner(problems_, path_of(key));
    visit_fields(inner, value);
  }

  template <typename T>
  void list(const char* key, std::vector<T>& values, const char* /*meaning*/) {
    for (std::size_t i = 0; i < values.size(); ++i) section(at(key, i).c_str(), values[i]);
  }

  /// What a setting must be by other settings; `demand` reads "must be …".
  void relation(const char* key, double value, bool holds, const char* demand) {
    if (!holds) refuse(path_of(key), demand, to_text(value));
  }

 private:
  static std::string at(const std::string& path, std::size_t i) {
    return path + "[" + std::to_string(i) + "]";
  }
  std::string path_of(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }
  void refuse(const std::string& path, const std::string& demand, const std::string& value);

  void check(const std::string& path, double value, const Range& range);
  void check(const std::string& path, const std::vector<int>& values, const ListRange& list);
  void check(const std::string& path, const std::string& text, const Form& form);
  void check(const std::string& path, const std::map<std::string, std::string>& texts, const Form& form);

  template <std::size_t N>
  void check(const std::string& path, const std::array<double, N>& values, const Range& range) {
    for (std::size_t i = 0; i < N; ++i) check(at(path, i), values[i], range);
  }

  template <typename T>
  void check(const std::string& path, const T& value, const Any& /*rule*/) {
    if constexpr (std::is_enum_v<T>) {
      if (name_of(value) == nullptr)
        refuse(path, "must be one of: " + list_names<T>(), std::to_string(static_cast<int>(value)));
    }
  }

  std::vector<std::string>& problems_;
  std::string path_;
};

/// Every problem of a structure that visit_fields() describes, named by its path in it, after `path`.
template <typename Config>
std::vector<std::string> check_fields(Config config,  // by value: the visit takes what it may change
                                      const std::string& path = {}) {
  std::vector<std::string> problems;
  FieldChecker checker(problems, path);
  visit_fields(checker, config);
  return problems;
}

}  // namespace geoloc
