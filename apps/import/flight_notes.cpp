// SPDX-License-Identifier: Apache-2.0
#include "import/flight_notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "import/name_list.hpp"

namespace geoloc::apps {
namespace {

std::vector<std::string> names_where(const std::vector<TimedStill>& stills,
                                     const std::function<bool(const io::StillAttitude&)>& condition) {
  std::vector<std::string> names;
  for (const TimedStill& timed : stills) {
    if (condition(timed.named.still.attitude)) names.push_back(timed.named.file.filename().string());
  }
  return names;
}

/// How the cameras looked that tell nothing of it: as the user says, or straight down.
void assume_pitch(const std::vector<std::string>& names, std::size_t all,
                  std::optional<double> told_pitch_deg, FlightPlan& plan) {
  constexpr double kToldSigma_deg = 2.0, kNadirSigma_deg = 5.0;
  if (names.empty()) {
    if (told_pitch_deg)
      plan.assumptions.push_back("--gimbal-pitch-deg is not used: the pictures tell how the camera looked");
    return;
  }
  plan.mount.pitch_deg = told_pitch_deg.value_or(plan.mount.pitch_deg);
  plan.sigma_attitude_deg = told_pitch_deg ? kToldSigma_deg : kNadirSigma_deg;
  const std::string how = told_pitch_deg ? fmt::format("with a pitch of {:g} degrees", *told_pitch_deg)
                                         : std::string("straight down");
  plan.assumptions.push_back(
      fmt::format("{} of {} pictures do not tell how the camera looked ({}): they are taken to look {}, to "
                  "{:g} degrees{}",
                  names.size(), all, name_list(names), how, plan.sigma_attitude_deg,
                  told_pitch_deg ? "" : " (--gimbal-pitch-deg says another pitch)"));
}

}  // namespace

bool tells_camera(const io::StillAttitude& attitude) {
  return attitude.source == io::AttitudeSource::kCamera || attitude.source == io::AttitudeSource::kBody;
}

void assume_attitudes(const std::vector<TimedStill>& stills, std::optional<double> told_pitch_deg,
                      FlightPlan& plan) {
  const auto without_angles =
      names_where(stills, [](const io::StillAttitude& attitude) { return !tells_camera(attitude); });
  const auto without_heading = names_where(
      stills, [](const io::StillAttitude& attitude) { return attitude.source == io::AttitudeSource::kNone; });
  const auto contradictory = names_where(stills, [](const io::StillAttitude& attitude) {
    constexpr double kMostTurn_deg = 90.0;
    return std::abs(attitude.yaw_difference_deg.value_or(0.0)) > kMostTurn_deg;
  });
  assume_pitch(without_angles, stills.size(), told_pitch_deg, plan);
  plan.is_heading_assumed = !without_heading.empty();
  if (!without_heading.empty())
    plan.assumptions.push_back(fmt::format(
        "{} of {} pictures tell no heading ({}): their top is taken to be where the vehicle flew to",
        without_heading.size(), stills.size(), name_list(without_heading)));
  if (!contradictory.empty())
    plan.assumptions.push_back(fmt::format(
        "{} of {} pictures tell a camera that looks to the rear of the vehicle ({}): the camera's heading is "
        "taken, not the vehicle's",
        contradictory.size(), stills.size(), name_list(contradictory)));
}

void note_rtk(const std::vector<TimedStill>& stills, FlightPlan& plan) {
  constexpr int kFixed = 50, kFloat = 34;
  std::size_t told = 0, fixed = 0, floating = 0;
  for (const TimedStill& timed : stills) {
    const auto& flag = timed.named.still.rtk_flag;
    told += flag ? 1 : 0;
    fixed += flag == kFixed ? 1 : 0;
    floating += flag == kFloat ? 1 : 0;
  }
  plan.is_synchronised = told == stills.size();
  if (told > 0)
    plan.notes.push_back(fmt::format("RTK: of {} pictures, {} have a fixed solution, {} a float one, {} none",
                                     stills.size(), fixed, floating, stills.size() - fixed - floating));
}

void note_zoom(FlightPlan& plan) {
  const auto zoomed = std::count_if(plan.exposures.begin(), plan.exposures.end(),
                                    [](const Exposure& exposure) { return exposure.focal_px.has_value(); });
  if (zoomed > 0)
    plan.notes.push_back(fmt::format(
        "zoom: {} of {} pictures have another focal length than most ({:.0f} px), and are located with it",
        zoomed, plan.exposures.size(), plan.camera.fx_px));
}

void note_heights(const std::vector<TimedStill>& stills, FlightPlan& plan) {
  const auto& first = stills.front().named.still;
  const bool is_ellipsoidal = first.datum == io::HeightDatum::kEllipsoid;
  const char* const datum = is_ellipsoidal ? "the ellipsoid" : "the sea";
  plan.notes.push_back(first.height_above_take_off_m
                           ? fmt::format("heights: above the take-off{}",
                                         first.height_absolute_m ? fmt::format(", and above {}", datum) : "")
                           : fmt::format("heights: above {}", datum));
}

}  // namespace geoloc::apps
