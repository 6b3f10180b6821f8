// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "last_error.hpp"
#include "settings/rules.hpp"

namespace geoloc::c {

using SettingValue = std::variant<double, std::string, std::vector<double>>;

/// Sets the one setting of a structure that visit_fields() describes which a path names; ranges are
/// FieldChecker's. Throws BadSetting where there is none, or the value is of another type.
class FieldSetter {
 public:
  FieldSetter(std::string path, const SettingValue& value)
      : whole_path_(path), path_(std::move(path)), value_(value) {}

  template <typename T, typename Rule>
  void field(const char* key, T& target, const Rule& /*rule*/, const char* /*unit*/,
             const char* /*meaning*/) {
    if (path_ != key) return;
    set(target);
    is_set_ = true;
  }

  template <typename T>
  void section(const char* key, T& target) {
    const std::string start = std::string(key) + ".";
    if (path_.rfind(start, 0) == 0) visit_rest(start.size(), target);
  }

  /// Entries are named list[0], list[1], …; the one past the last begins a new one.
  template <typename T>
  void list(const char* key, std::vector<T>& targets, const char* /*meaning*/) {
    const std::string start = std::string(key) + "[";
    const std::size_t end = path_.find("].");
    if (path_.rfind(start, 0) != 0 || end == std::string::npos || end > start.size() + 6) return;
    const std::string digits = path_.substr(start.size(), end - start.size());
    if (digits.empty() || digits.find_first_not_of("0123456789") != std::string::npos) return;
    const std::size_t place = std::stoul(digits);
    if (place > targets.size()) refuse("skips entries: the next one is " + std::to_string(targets.size()));
    T entry = place < targets.size() ? targets[place] : T{};
    visit_rest(end + 2, entry);
    if (!is_set_) return;
    if (place == targets.size()) targets.emplace_back();
    targets[place] = entry;
  }

  void relation(const char* /*key*/, double /*value*/, bool /*holds*/, const char* /*demand*/) {}

  void require_set() const {
    if (!is_set_) refuse("is not a setting; docs/settings.md has them all");
  }

 private:
  template <typename T>
  void visit_rest(std::size_t size, T& target) {
    const std::string above = path_;
    path_ = path_.substr(size);
    visit_fields(*this, target);
    path_ = above;
  }

  [[noreturn]] void refuse(const std::string& why) const { throw BadSetting(whole_path_ + " " + why); }

  double number() const {
    const auto* number = std::get_if<double>(&value_);
    if (number == nullptr || !std::isfinite(*number)) refuse("must be a finite number");
    return *number;
  }
  int whole(double number) const {
    if (std::trunc(number) != number || std::abs(number) > std::numeric_limits<int>::max())
      refuse("must be a whole number, but is " + to_text(number));
    return static_cast<int>(number);
  }
  const std::vector<double>& numbers(std::size_t at_most) const {
    const auto* numbers = std::get_if<std::vector<double>>(&value_);
    if (numbers == nullptr || numbers->size() > at_most)
      refuse("must be a list of at most " + std::to_string(at_most) + " numbers");
    for (const double value : *numbers) {
      if (!std::isfinite(value)) refuse("must be a list of finite numbers");
    }
    return *numbers;
  }
  const std::string& text() const {
    const auto* text = std::get_if<std::string>(&value_);
    if (text == nullptr) refuse("must be a text");
    return *text;
  }

  void set(double& target) const { target = number(); }
  void set(int& target) const { target = whole(number()); }
  void set(bool& target) const {
    const double value = number();
    if (value != 0.0 && value != 1.0) refuse("must be 0 or 1, but is " + to_text(value));
    target = value == 1.0;
  }
  void set(std::string& target) const { target = text(); }

  template <std::size_t N>
  void set(std::array<double, N>& target) const {
    const std::vector<double>& values = numbers(N);
    target.fill(0.0);
    for (std::size_t i = 0; i < values.size(); ++i) target[i] = values[i];
  }
  void set(std::vector<int>& target) const {
    constexpr std::size_t kLongest = 1000;
    target.clear();
    for (const double value : numbers(kLongest)) target.push_back(whole(value));
  }

  template <typename Enum, typename = std::enable_if_t<std::is_enum_v<Enum>>>
  void set(Enum& target) const {
    for (const auto& [candidate, name] : EnumNames<Enum>::all) {
      if (text() != name) continue;
      target = candidate;
      return;
    }
    refuse("must be one of: " + list_names<Enum>());
  }

  std::string whole_path_;
  std::string path_;  // what is left of it, in the present section
  const SettingValue& value_;
  bool is_set_ = false;
};

}  // namespace geoloc::c
