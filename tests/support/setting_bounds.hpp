// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "settings/rules.hpp"

// Every numeric setting of a structure that visit_fields() describes, tried at both ends of its range.
namespace geoloc::testing {

/// A value to try, and whether its range holds it.
struct Probe {
  std::string path;
  Range range;
  double value;
  bool is_inside;
};

/// Calls `on_number(path, number, range)` for each number; `number` is assignable.
template <typename OnNumber>
class NumberVisitor {
 public:
  explicit NumberVisitor(OnNumber& on_number, std::string path = {})
      : on_number_(on_number), path_(std::move(path)) {}

  template <typename Number>
  std::enable_if_t<std::is_arithmetic_v<Number>> field(const char* key, Number& value, const Range& range,
                                                       const char* /*unit*/, const char* /*meaning*/) {
    on_number_(path_ + key, value, range);
  }
  template <std::size_t N>
  void field(const char* key, std::array<double, N>& values, const Range& range, const char* /*unit*/,
             const char* /*meaning*/) {
    for (std::size_t i = 0; i < N; ++i)
      on_number_(path_ + key + "[" + std::to_string(i) + "]", values[i], range);
  }
  void field(const char* key, std::vector<int>& values, const ListRange& list, const char* /*unit*/,
             const char* /*meaning*/) {
    values.resize(1);
    on_number_(path_ + key + "[0]", values[0], list.each);
  }
  template <typename T, typename Rule>
  std::enable_if_t<!std::is_same_v<Rule, Range>> field(const char* /*key*/, T& /*value*/,
                                                       const Rule& /*rule*/, const char* /*unit*/,
                                                       const char* /*meaning*/) {}

  template <typename T>
  void section(const std::string& key, T& value) {
    NumberVisitor inner(on_number_, path_ + key + ".");
    visit_fields(inner, value);
  }
  template <typename T>
  void list(const std::string& key, std::vector<T>& values, const char* /*meaning*/) {
    values.resize(1);
    section(key + "[0]", values[0]);
  }
  void relation(const char* /*key*/, double /*value*/, bool /*holds*/, const char* /*demand*/) {}

 private:
  OnNumber& on_number_;
  std::string path_;
};

/// Inside and outside of each end, and NaN.
template <typename Number>
void add_probes(const std::string& path, const Number& /*number*/, const Range& range,
                std::vector<Probe>& probes) {
  const auto neighbour = [](double value, double towards) {
    if constexpr (std::is_same_v<Number, int>) return value + (towards > value ? 1.0 : -1.0);
    return std::nextafter(value, towards);
  };
  const auto add = [&](double value, bool is_inside) {
    if (std::is_same_v<Number, int> && std::abs(value) > std::numeric_limits<int>::max()) return;
    probes.push_back({path, range, value, is_inside});
  };
  const auto add_end = [&](double end, bool is_included, double inwards) {
    add(is_included ? end : neighbour(end, inwards), true);
    if (!is_included) add(end, false);
    if (is_included && std::isfinite(end)) add(neighbour(end, -inwards), false);
  };
  add_end(range.low, range.includes_low, Range::kInfinity);
  add_end(range.high, range.includes_high, -Range::kInfinity);
  if (!std::is_same_v<Number, int>) add(std::numeric_limits<double>::quiet_NaN(), false);
}

/// Tries every bound of `Config`; `problems_of(config)` lists what is wrong with one. The number of probes.
template <typename Config, typename ProblemsOf>
std::size_t expect_bounds_are_kept(const ProblemsOf& problems_of) {
  std::vector<Probe> probes;
  Config defaults;
  const auto collect = [&probes](const std::string& path, const auto& number, const Range& range) {
    add_probes(path, number, range, probes);
  };
  NumberVisitor collector(collect);
  visit_fields(collector, defaults);

  for (const Probe& probe : probes) {
    Config config;
    const auto assign = [&probe](const std::string& path, auto& number, const Range& /*range*/) {
      if (path == probe.path) number = static_cast<std::decay_t<decltype(number)>>(probe.value);
    };
    NumberVisitor setter(assign);
    visit_fields(setter, config);
    const std::vector<std::string> problems = problems_of(config);
    const std::string fault =
        probe.path + " must lie in " + to_text(probe.range) + ", but is " + to_text(probe.value);
    EXPECT_EQ(std::count(problems.begin(), problems.end(), fault), probe.is_inside ? 0 : 1)
        << fault << " among " << ::testing::PrintToString(problems);
  }
  return probes.size();
}

template <typename Config>
std::size_t expect_bounds_are_kept() {
  return expect_bounds_are_kept<Config>([](const Config& config) { return config.problems(); });
}

}  // namespace geoloc::testing
