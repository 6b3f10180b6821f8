// SPDX-License-Identifier: Apache-2.0
#include "common/gimbal_news.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "geoloc/state/state_provider.hpp"

namespace geoloc::apps {
namespace {

const char* name_of(GimbalYaw yaw) {
  return yaw == GimbalYaw::kFromNose ? "the vehicle's nose" : "north";
}

/// Those that make its angles doubtful: a gimbal at the end of an axis, or without a manager, tells them as
/// well as before.
std::string names_of_failures(std::uint32_t flags) {
  constexpr std::array<std::pair<std::uint32_t, const char*>, 6> kFailures{{{8, "encoders"},
                                                                            {16, "power"},
                                                                            {32, "motors"},
                                                                            {64, "software"},
                                                                            {128, "communication"},
                                                                            {256, "being calibrated"}}};
  std::string names;
  for (const auto& [flag, name] : kFailures) {
    if ((flags & flag) != 0) names += (names.empty() ? "" : ", ") + std::string(name);
  }
  return names;
}

std::string on_yaw(const Geolocator& geolocator) {
  const GimbalHistory& gimbal = geolocator.state().gimbal();
  if (!gimbal.is_yaw_told_wrong() || !gimbal.newest()) return {};
  const GimbalYaw told = gimbal.newest()->yaw, used = gimbal.reading(told);
  const std::string contradiction = fmt::format(
      "the gimbal says that its yaw counts from {}, and what it does while the vehicle turns contradicts "
      "that",
      name_of(told));
  const std::string taken = fmt::format(": it is taken to count from {}", name_of(used));
  if (geolocator.config().state.gimbal_yaw != GimbalYawReading::kAsTold)
    return contradiction + taken + ", as state.gimbal_yaw asks for";
  return contradiction + taken +
         fmt::format(", and objects of before are void (state.gimbal_yaw \"{}\" would take it as told)",
                     told == GimbalYaw::kFromNose ? "nose" : "north");
}

std::string on_set_point(const Geolocator& geolocator) {
  if (!geolocator.state().gimbal().is_set_point()) return {};
  return "the gimbal's angles have no noise while the vehicle shakes: they seem to be those that it was told "
         "to "
         "hold, and count as wrong by 0.5 deg (1 sigma); frames of fast turns are left out, and objects of "
         "before are void";
}

}  // namespace

void GimbalNews::note(const Geolocator& geolocator, std::uint32_t failure_flags,
                      std::vector<std::string>& lines) {
  const GimbalHistory& gimbal = geolocator.state().gimbal();
  if (!std::exchange(is_yaw_told_wrong_, gimbal.is_yaw_told_wrong()) && is_yaw_told_wrong_)
    lines.push_back(on_yaw(geolocator));
  if (!std::exchange(is_set_point_, gimbal.is_set_point()) && is_set_point_)
    lines.push_back(on_set_point(geolocator));
  const std::string failures = names_of_failures(failure_flags & ~told_failures_);
  told_failures_ |= failure_flags;
  if (!failures.empty())
    lines.push_back("the gimbal reports a failure: " + failures + "; its angles may be off");
}

std::string remark_on_gimbal(const Geolocator& geolocator) {
  const std::string yaw = on_yaw(geolocator), set_point = on_set_point(geolocator);
  return yaw + (yaw.empty() || set_point.empty() ? "" : "\n") + set_point;
}

}  // namespace geoloc::apps
