// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

// Which values a setting may take. Each setting is described once, in a *_fields.hpp beside the sources:
//
//   template <class Visitor>
//   void visit_fields(Visitor& v, Wheel& wheel) {
//     v.field("radius_m", wheel.radius_m, Range::above(0, 10), "m", "Unloaded radius");
//     v.section("tyre", wheel.tyre);         // a structure that is described likewise
//     v.list("spokes", wheel.spokes, "…");   // of such structures
//     v.relation("radius_m", wheel.radius_m, wheel.radius_m > wheel.hub_m, "must be larger than hub_m");
//   }
//
// FieldChecker makes problems() of it; io's FieldReader, FieldWriter and FieldLister read, print and
// document.
namespace geoloc {

/// An interval of numbers. NaN lies in none.
struct Range {
  double low;
  double high;
  bool includes_low;
  bool includes_high;

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  static constexpr Range closed(double low, double high) { return {low, high, true, true}; }  ///< [low, high]
  static constexpr Range open(double low, double high) { return {low, high, false, false}; }  ///< (low, high)
  static constexpr Range above(double low, double high) { return {low, high, false, true}; }  ///< (low, high]
  static constexpr Range below(double low, double high) { return {low, high, true, false}; }  ///< [low, high)
  static constexpr Range at_least(double low) { return below(low, kInfinity); }               ///< [low, inf)
  static constexpr Range positive() { return open(0.0, kInfinity); }                          ///< (0, inf)
  static constexpr Range finite() { return open(-kInfinity, kInfinity); }                     ///< (-inf, inf)

  constexpr bool contains(double value) const {
    return (includes_low ? value >= low : value > low) && (includes_high ? value <= high : value < high);
  }
};

/// Lists of at most `longest` whole numbers, each within a range.
struct ListRange {
  Range each;
  std::size_t longest;
};

/// Texts of a form; `wanted` completes "must be …".
struct Form {
  bool (*holds)(const std::string& text);
  const char* wanted;
};

/// Every value of the setting's type.
struct Any {};

/// How the enumerators of a setting are spelt. Specialise `EnumNames<E>::all`.
template <typename Enum>
struct EnumNames;

/// The spelling of an enumerator; nullptr for a value that is none.
template <typename Enum>
const char* name_of(Enum value) {
  for (const auto& [candidate, name] : EnumNames<Enum>::all) {
    if (candidate == value) return name;
  }
  return nullptr;
}

/// "red, blue"
template <typename Enum>
std::string list_names() {
  std::string names;
  for (const auto& [candidate, name] : EnumNames<Enum>::all)
    names += (names.empty() ? "" : ", ") + std::string(name);
  return names;
}

/// The shortest of 15 and 17 digits that gives the same number back.
std::string to_text(double value);
/// "(0, 1000]"
std::string to_text(const Range& range);

/// What a setting of type T may be, for its documentation; empty where anything goes.
template <typename T>
std::string allowed(const Range& range) {
  return to_text(range);
}
template <typename T>
std::string allowed(const ListRange& list) {
  return "each in " + to_text(list.each) + ", at most " + std::to_string(list.longest);
}
template <typename T>
std::string allowed(const Form& form) {
  return form.wanted;
}
template <typename T>
std::string allowed(const Any& /*rule*/) {
  if constexpr (std::is_enum_v<T>) return list_names<T>();
  if constexpr (std::is_same_v<T, bool>) return "true, false";
  return {};
}

}  // namespace geoloc
