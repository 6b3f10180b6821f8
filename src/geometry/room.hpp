// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

/// Memory that is taken at construction. A class states its buffers once, in a function
/// `static std::size_t take_room(Self* self, …)` that its constructor calls with `this`: it takes them, and
/// returns how many bytes they are, with those of its parts. With nullptr nothing is taken: that is how
/// memory_needed() knows. Bytes are those asked of the heap, which adds its own to each.
namespace geoloc::room {

template <class Owner, class Value>
std::size_t reserve(Owner* owner, std::vector<Value> Owner::*buffer, std::size_t count) {
  if (owner != nullptr) (owner->*buffer).reserve(count);
  return count * sizeof(Value);  // NOLINT(bugprone-sizeof-expression): also where these are pointers
}

template <class Owner, class Value>
std::size_t resize(Owner* owner, std::vector<Value> Owner::*buffer, std::size_t count) {
  if (owner != nullptr) (owner->*buffer).resize(count);
  return count * sizeof(Value);  // NOLINT(bugprone-sizeof-expression): also where these are pointers
}

template <class Owner, class Scalar, int Rows, int Columns, int Options, int MaxRows, int MaxColumns>
std::size_t resize(Owner* owner,
                   Eigen::Matrix<Scalar, Rows, Columns, Options, MaxRows, MaxColumns> Owner::*buffer,
                   Eigen::Index rows, Eigen::Index columns = 1) {
  if (owner != nullptr) (owner->*buffer).resize(rows, columns);
  return static_cast<std::size_t>(rows * columns) * sizeof(Scalar);
}

/// A part that takes its room with its owner's.
template <class Owner, class Part>
Part* part(Owner* owner, Part Owner::*member) {
  return owner != nullptr ? &(owner->*member) : nullptr;
}

/// Of `new Value[count]`: what must be destroyed is counted in front of it.
template <class Value>
constexpr std::size_t bytes_of_array(std::size_t count) {
  constexpr bool is_counted = !std::is_trivially_destructible_v<Value>;
  return count * sizeof(Value) + (is_counted ? std::max(sizeof(std::size_t), alignof(Value)) : 0);
}

/// Of a copy.
template <class Value>
std::size_t bytes_of_copy(const std::vector<Value>& values) {
  return values.size() * sizeof(Value);
}

/// Of a copy: short texts are kept in place.
inline std::size_t bytes_of_copy(const std::string& text) {
  return text.size() > std::string().capacity() ? text.size() + 1 : 0;
}

}  // namespace geoloc::room
