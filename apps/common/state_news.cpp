// SPDX-License-Identifier: Apache-2.0
#include "common/state_news.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/count_list.hpp"
#include "geoloc/geometry/angles.hpp"

namespace geoloc::apps {
namespace {

constexpr const char* kConsequence =
    ", which it cannot have moved: what is mapped stays where it is, and the flight goes on from there";

/// Whether there is one more of a kind than before, and the first.
bool is_first(std::uint64_t count, std::uint64_t before) {
  return before == 0 && count > 0;
}

}  // namespace

void StateNews::note(const StateProvider& state) {
  const StateProvider::Counters now = state.counters();
  const StateSteps steps = state.steps();
  const Eigen::Vector4d size = steps.size - steps_.size;
  if (is_first(now.home_moves, told_.home_moves)) {
    const double up_m = state.home().moved_up_m();
    lines_.push_back(fmt::format("the vehicle's home was set {:.1f} m {}: heights stay above the first one",
                                 std::abs(up_m), up_m > 0.0 ? "higher" : "lower"));
  }
  if (is_first(now.position_steps, told_.position_steps))
    lines_.push_back(
        fmt::format("the vehicle's position jumped by {:.1f} m{}", size.head<2>().norm(), kConsequence));
  if (is_first(now.height_steps, told_.height_steps))
    lines_.push_back(fmt::format("the vehicle's height jumped by {:+.1f} m{}", size[2], kConsequence));
  if (is_first(now.yaw_steps, told_.yaw_steps))
    lines_.push_back(
        fmt::format("the vehicle's yaw jumped by {:+.0f} deg{}", size[3] * kDegPerRad, kConsequence));
  told_ = now;
  steps_ = steps;
}

void StateNews::note_frame(const Geolocator& geolocator) {
  const std::uint64_t turned = geolocator.track_counters().frames_turned;
  if (is_first(turned, told_turned_))
    lines_.push_back(
        fmt::format("the yaw told for frame {} is 180 deg off, as known objects in it show: such "
                    "frames are used turned round",
                    geolocator.counters().frames));
  told_turned_ = turned;
}

std::string count_of_turned(const Geolocator& geolocator) {
  const std::uint64_t turned = geolocator.track_counters().frames_turned;
  return turned == 0 ? ""
                     : fmt::format("frames used turned round, since their yaw was 180 deg off: {}", turned);
}

std::string count_of_jumps(const StateProvider::Counters& counters) {
  return list_of_counts("jumps noticed in the vehicle's state", {{counters.position_steps, "of the position"},
                                                                 {counters.height_steps, "of the height"},
                                                                 {counters.yaw_steps, "of the yaw"},
                                                                 {counters.home_moves, "of home"}});
}

}  // namespace geoloc::apps
