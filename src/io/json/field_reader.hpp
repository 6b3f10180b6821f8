// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "settings/rules.hpp"

namespace geoloc::io {

/// Fills a structure that visit_fields() describes from a JSON object. Whatever is of another type, and an
/// unknown key, becomes a problem that names its path and the value met; ranges are FieldChecker's.
class FieldReader {
 public:
  FieldReader(const nlohmann::json& object, std::string path, std::vector<std::string>& problems)
      : object_(object), path_(std::move(path)), problems_(problems) {
    if (!object_.is_object()) refuse(path_of(""), "must be an object", object_);
  }

  template <typename T, typename Rule>
  void field(const char* key, T& value, const Rule& /*rule*/, const char* /*unit*/, const char* /*meaning*/) {
    if (const nlohmann::json* const found = find(key)) read(*found, path_of(key), value);
  }

  template <typename T>
  void section(const char* key, T& value) {
    if (const nlohmann::json* const found = find(key)) read_object(*found, path_of(key), value);
  }

  template <typename T>
  void list(const char* key, std::vector<T>& values, const char* /*meaning*/) {
    const nlohmann::json* const found = find(key);
    if (found == nullptr) return;
    if (!found->is_array()) return refuse(path_of(key), "must be a list", *found);
    values.assign(found->size(), T{});
    for (std::size_t i = 0; i < values.size(); ++i) read_object((*found)[i], at(path_of(key), i), values[i]);
  }

  void relation(const char* /*key*/, double /*value*/, bool /*holds*/, const char* /*demand*/) {}

  /// A key that is no setting here and may stand there nevertheless.
  void ignore(const std::string& key) { known_.push_back(key); }

  void refuse_unknown();

 private:
  static std::string at(const std::string& path, std::size_t i) {
    return path + "[" + std::to_string(i) + "]";
  }
  std::string path_of(const std::string& key) const {
    if (path_.empty()) return key.empty() ? "the document" : key;
    return key.empty() ? path_ : path_ + "." + key;
  }
  std::string suggestion(const std::string& key) const;
  void refuse(const std::string& path, const std::string& demand, const nlohmann::json& value);

  /// What stands under a key, which is known from now on; nullptr where nothing does.
  const nlohmann::json* find(const char* key) {
    known_.emplace_back(key);
    if (!object_.is_object()) return nullptr;
    const auto found = object_.find(key);
    return found == object_.end() ? nullptr : &*found;
  }

  void read(const nlohmann::json& json, const std::string& path, double& value);
  void read(const nlohmann::json& json, const std::string& path, int& value);
  void read(const nlohmann::json& json, const std::string& path, bool& value);
  void read(const nlohmann::json& json, const std::string& path, std::string& value);
  void read(const nlohmann::json& json, const std::string& path, std::map<std::string, std::string>& value);

  template <typename T>
  void read_object(const nlohmann::json& json, const std::string& path, T& value) {
    FieldReader inner(json, path, problems_);
    visit_fields(inner, value);
    inner.refuse_unknown();
  }

  template <typename T, std::size_t N>
  void read(const nlohmann::json& json, const std::string& path, std::array<T, N>& values) {
    if (!json.is_array() || json.size() > N)
      return refuse(path, "must be a list of at most " + std::to_string(N) + " numbers", json);
    values.fill(T{});
    for (std::size_t i = 0; i < json.size(); ++i) read(json[i], at(path, i), values[i]);
  }

  template <typename T>
  void read(const nlohmann::json& json, const std::string& path, std::vector<T>& values) {
    if (!json.is_array()) return refuse(path, "must be a list", json);
    values.assign(json.size(), T{});
    for (std::size_t i = 0; i < json.size(); ++i) read(json[i], at(path, i), values[i]);
  }

  template <typename Enum, typename = std::enable_if_t<std::is_enum_v<Enum>>>
  void read(const nlohmann::json& json, const std::string& path, Enum& value) {
    for (const auto& [candidate, spelling] : EnumNames<Enum>::all) {
      if (json.is_string() && json.get_ref<const std::string&>() == spelling) {
        value = candidate;
        return;
      }
    }
    refuse(path, "must be one of: " + list_names<Enum>(), json);
  }

  const nlohmann::json& object_;
  std::string path_;
  std::vector<std::string>& problems_;
  std::vector<std::string> known_;
};

}  // namespace geoloc::io
