// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/gimbal_news.hpp"
#include "geoloc/pipeline/geolocator.hpp"
#include "geoloc/state/state_provider.hpp"

namespace geoloc::apps {

/// What a user is told of a vehicle whose state jumps: a line at the first of each kind.
class StateNews {
 public:
  /// After each sample.
  void note(const StateProvider& state);

  /// After each frame.
  void note_frame(const Geolocator& geolocator);

  /// After each sample of a gimbal.
  void note_gimbal(const Geolocator& geolocator, std::uint32_t failure_flags) {
    gimbal_.note(geolocator, failure_flags, lines_);
  }

  /// What is new since the last call.
  std::vector<std::string> take() { return std::exchange(lines_, {}); }

 private:
  StateProvider::Counters told_;  // of what a line was told, and counts since
  StateSteps steps_;
  std::uint64_t told_turned_ = 0;
  GimbalNews gimbal_;
  std::vector<std::string> lines_;
};

/// A line that counts them; empty where there were none.
std::string count_of_jumps(const StateProvider::Counters& counters);

/// The same of frames whose yaw was told the wrong way round.
std::string count_of_turned(const Geolocator& geolocator);

}  // namespace geoloc::apps
