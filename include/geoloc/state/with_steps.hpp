// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "geoloc/state/state_buffer.hpp"
#include "geoloc/state/vehicle_state.hpp"

namespace geoloc {

/// A sample with the steps of its own quantity up to it.
template <typename T>
struct WithSteps {
  T value;
  StateSteps steps;
};

/// Nothing is known of between two samples with a step from one to the other.
template <typename Sample>
std::optional<NoState> step_in(const Bracket<Sample>& bracket) {
  if (bracket.before.steps.segment == bracket.after.steps.segment) return std::nullopt;
  return bracket.alpha > 1.0 ? NoState::kNotYet : NoState::kInAGap;
}

}  // namespace geoloc
