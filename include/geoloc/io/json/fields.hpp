// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

// A structure is described once, by `template <class V> void visit_fields(V& v, Structure& s)` that names
// each field; FieldReader, FieldWriter and FieldLister turn that one description into reading, printing and
// documenting it.
namespace geoloc::io {

/// The spelling of an enumerator in JSON. Specialise `EnumNames<E>::all`.
template <typename Enum>
struct EnumNames;

/// Fills a structure from a JSON object; whatever is wrong, an unknown key too, becomes a problem that names
/// its path.
class FieldReader {
 public:
  FieldReader(const nlohmann::json& object, std::string path, std::vector<std::string>& problems)
      : object_(object), path_(std::move(path)), problems_(problems) {
    if (!object_.is_object()) problems_.push_back(name("") + " must be an object");
  }

  template <typename T>
  void field(const char* key, T& value, const char* /*meaning*/) {
    known_.emplace_back(key);
    if (!object_.is_object()) return;
    if (const auto found = object_.find(key); found != object_.end()) read(*found, name(key), value);
  }

  template <typename T>
  void section(const char* key, T& value) {
    known_.emplace_back(key);
    if (!object_.is_object()) return;
    const auto found = object_.find(key);
    if (found == object_.end()) return;
    FieldReader inner(*found, name(key), problems_);
    visit_fields(inner, value);
    inner.refuse_unknown();
  }

  void refuse_unknown() {
    if (!object_.is_object()) return;
    for (const auto& [key, ignored] : object_.items()) {
      bool known = false;
      for (const std::string& candidate : known_) known = known || candidate == key;
      if (!known) problems_.push_back(name(key) + " is not a setting; " + suggestion(key));
    }
  }

 private:
  std::string name(const std::string& key) const {
    if (path_.empty()) return key.empty() ? "the document" : key;
    return key.empty() ? path_ : path_ + "." + key;
  }
  std::string suggestion(const std::string& key) const;

  void read(const nlohmann::json& json, const std::string& path, double& value);
  void read(const nlohmann::json& json, const std::string& path, int& value);
  void read(const nlohmann::json& json, const std::string& path, bool& value);
  void read(const nlohmann::json& json, const std::string& path, std::string& value);
  void read(const nlohmann::json& json, const std::string& path, std::map<std::string, std::string>& value);

  template <typename T, std::size_t N>
  void read(const nlohmann::json& json, const std::string& path, std::array<T, N>& values) {
    if (!json.is_array() || json.size() > N) {
      problems_.push_back(path + " must be a list of at most " + std::to_string(N) + " numbers");
      return;
    }
    values.fill(T{});
    for (std::size_t i = 0; i < json.size(); ++i)
      read(json[i], path + "[" + std::to_string(i) + "]", values[i]);
  }

  template <typename T>
  void read(const nlohmann::json& json, const std::string& path, std::vector<T>& values) {
    if (!json.is_array()) {
      problems_.push_back(path + " must be a list");
      return;
    }
    values.assign(json.size(), T{});
    for (std::size_t i = 0; i < json.size(); ++i)
      read(json[i], path + "[" + std::to_string(i) + "]", values[i]);
  }

  template <typename Enum, typename = std::enable_if_t<std::is_enum_v<Enum>>>
  void read(const nlohmann::json& json, const std::string& path, Enum& value) {
    std::string choices;
    for (const auto& [candidate, spelling] : EnumNames<Enum>::all) {
      if (json.is_string() && json.get_ref<const std::string&>() == spelling) {
        value = candidate;
        return;
      }
      choices += (choices.empty() ? "" : ", ") + std::string(spelling);
    }
    problems_.push_back(path + " must be one of: " + choices);
  }

  const nlohmann::json& object_;
  std::string path_;
  std::vector<std::string>& problems_;
  std::vector<std::string> known_;
};

/// Builds the JSON object that FieldReader accepts back.
class FieldWriter {
 public:
  template <typename T>
  void field(const char* key, const T& value, const char* /*meaning*/) {
    if constexpr (std::is_enum_v<T>) {
      for (const auto& [candidate, spelling] : EnumNames<T>::all) {
        if (candidate == value) object_[key] = spelling;
      }
    } else {
      object_[key] = value;
    }
  }

  template <typename T>
  void section(const char* key, T& value) {
    FieldWriter inner;
    visit_fields(inner, value);
    object_[key] = inner.take();
  }

  nlohmann::ordered_json take() { return std::move(object_); }

 private:
  nlohmann::ordered_json object_ = nlohmann::ordered_json::object();
};

/// A line of the settings' reference: path, default, meaning with its unit.
struct FieldLine {
  std::string path;
  std::string default_value;
  std::string meaning;
};

class FieldLister {
 public:
  explicit FieldLister(std::vector<FieldLine>& lines, std::string path = {})
      : lines_(lines), path_(std::move(path)) {}

  template <typename T>
  void field(const char* key, const T& value, const char* meaning) {
    FieldWriter writer;
    writer.field(key, value, meaning);
    lines_.push_back({prefix() + key, writer.take()[key].dump(), meaning});
  }

  template <typename T>
  void section(const char* key, T& value) {
    FieldLister inner(lines_, prefix() + key);
    visit_fields(inner, value);
  }

 private:
  std::string prefix() const { return path_.empty() ? path_ : path_ + "."; }

  std::vector<FieldLine>& lines_;
  std::string path_;
};

}  // namespace geoloc::io
