// SPDX-License-Identifier: Apache-2.0
#include "import/flight_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "geoloc/geometry/angles.hpp"
#include "import/exposure_heights.hpp"
#include "import/exposure_times.hpp"
#include "import/flight_notes.hpp"
#include "import/way.hpp"

namespace geoloc::apps {
namespace {

using namespace std::chrono_literals;

/// The flights of one day; telemetry's clock would hold 49 days.
constexpr Duration kLongestSpan = 24h;
/// Between pictures farther apart, a vehicle may have gone anywhere.
constexpr double kLongestLeg_s = 20.0;

template <typename IsUsable>
void leave_out_unless(std::vector<NamedStill>& stills, const char* reason, std::vector<std::string>& left_out,
                      const IsUsable& is_usable) {
  const auto usable_end = std::stable_partition(stills.begin(), stills.end(), is_usable);
  for (auto it = usable_end; it != stills.end(); ++it) left_out.push_back(it->file.string() + ": " + reason);
  stills.erase(usable_end, stills.end());
}

/// One camera has one size and one lens, which may zoom.
using CameraKey = std::tuple<int, int, double, double, std::array<double, 5>>;

CameraKey camera_of(const io::Still& still) {
  const CameraIntrinsics& lens = still.lens->intrinsics;
  return {still.width_px, still.height_px, lens.cx_px, lens.cy_px, lens.distortion};
}

long focal_key(const io::Still& still) {
  return std::lround(still.lens->intrinsics.fx_px);
}

/// What most of the stills have, whose lens must be told; the least of those that are as common.
template <typename KeyOf>
auto most_common(const std::vector<NamedStill>& stills, const KeyOf& key_of) {
  std::map<decltype(key_of(stills.front().still)), std::size_t> counts;
  for (const NamedStill& named : stills) {
    if (named.still.lens) ++counts[key_of(named.still)];
  }
  return std::max_element(counts.begin(), counts.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

/// The lens of the first picture with the focal length that most pictures have; nullopt where none tells one.
std::optional<io::Lens> most_common_lens(const std::vector<NamedStill>& stills) {
  const auto tells_lens = [](const NamedStill& named) { return named.still.lens.has_value(); };
  if (std::none_of(stills.begin(), stills.end(), tells_lens)) return std::nullopt;
  const long focal = most_common(stills, focal_key);
  const auto found = std::find_if(stills.begin(), stills.end(), [&](const NamedStill& named) {
    return named.still.lens && focal_key(named.still) == focal;
  });
  return found->still.lens;
}

void keep_one_camera(std::vector<NamedStill>& stills, const FlightFacts& facts, FlightPlan& plan) {
  if (facts.lens) {
    leave_out_unless(stills, "has another size than the camera of --camera", plan.left_out,
                     [&](const NamedStill& named) {
                       return named.still.width_px == facts.lens->intrinsics.width_px &&
                              named.still.height_px == facts.lens->intrinsics.height_px;
                     });
    plan.camera = facts.lens->intrinsics;
    return;
  }
  leave_out_unless(stills, "tells no focal length, which --camera may give", plan.left_out,
                   [](const NamedStill& named) { return named.still.lens.has_value(); });
  if (stills.empty()) return;
  const CameraKey camera = most_common(stills, camera_of);
  leave_out_unless(stills, "has another size or lens than most; import these by themselves", plan.left_out,
                   [&](const NamedStill& named) { return camera_of(named.still) == camera; });
  const io::Lens lens = *most_common_lens(stills);
  plan.camera = lens.intrinsics;
  if (!facts.lens) plan.sigma_focal_percent = io::sigma_focal_percent(lens.source);
  if (lens.source == io::FocalSource::k35mm)
    plan.assumptions.push_back(
        fmt::format("the focal length is the pictures' equivalent for film of 35 mm, {:.0f} px to {:g} %, an "
                    "unknown of the calibration (--camera gives a better one)",
                    lens.intrinsics.fx_px, plan.sigma_focal_percent));
}

/// Those that differ by less are of one focal length, as it is focused.
constexpr double kSameFocalLength = 0.01;

/// A picture's focal length by the camera's, as far as it tells how much longer its own is than that of most.
std::optional<Eigen::Vector2d> zoomed_focal_px(const io::Still& still, const std::optional<io::Lens>& usual,
                                               const CameraIntrinsics& camera) {
  if (!still.lens || !usual) return std::nullopt;
  const double zoom = still.lens->intrinsics.fx_px / usual->intrinsics.fx_px;
  if (std::abs(zoom - 1.0) < kSameFocalLength) return std::nullopt;
  return Eigen::Vector2d(zoom * camera.fx_px, zoom * camera.fy_px);
}

bool is_leg(const Exposure& from, const Exposure& to) {
  return seconds(to.at - from.at) <= kLongestLeg_s;
}

/// By the pictures before and after, as far as they are of the same leg.
void take_velocities(std::vector<Exposure>& exposures) {
  for (std::size_t i = 0; i < exposures.size(); ++i) {
    const bool has_before = i > 0 && is_leg(exposures[i - 1], exposures[i]);
    const bool has_after = i + 1 < exposures.size() && is_leg(exposures[i], exposures[i + 1]);
    const Exposure& from = exposures[i - (has_before ? 1 : 0)];
    const Exposure& to = exposures[i + (has_after ? 1 : 0)];
    if (has_before || has_after)
      exposures[i].position.velocity_in_enu = way(from.position, to.position) / seconds(to.at - from.at);
  }
}

/// A camera below a vehicle that flies ahead has its top towards where it flies.
void take_courses(std::vector<Exposure>& exposures, const std::vector<TimedStill>& stills) {
  for (std::size_t i = 0; i < exposures.size(); ++i) {
    const auto& velocity = exposures[i].position.velocity_in_enu;
    if (stills[i].named.still.attitude.source == io::AttitudeSource::kNone && velocity)
      exposures[i].attitude.angles.yaw_rad = std::atan2(velocity->x(), velocity->y());
  }
}

Exposure exposure_of(const TimedStill& timed, HostTime begin) {
  const io::Still& still = timed.named.still;
  Exposure exposure;
  exposure.file = timed.named.file;
  exposure.at = timed.at;
  const VehicleTime since_boot{timed.at - begin + Duration{1s}};
  exposure.position.time = since_boot;
  exposure.position.position = still.position;
  exposure.attitude = {since_boot, still.attitude.vehicle};
  if (tells_camera(still.attitude)) exposure.mount = still.attitude.mount;
  if (still.sigma_horizontal_m) {
    constexpr std::uint8_t kFix3d = 3, kRtkFloat = 5, kRtkFixed = 6;
    const int flag = still.rtk_flag.value_or(0);
    exposure.gnss = io::GnssClaim{flag == 50   ? kRtkFixed
                                  : flag == 34 ? kRtkFloat
                                               : kFix3d,
                                  still.sigma_horizontal_m, still.sigma_height_m};
  }
  return exposure;
}

void refuse_long_span(const std::vector<TimedStill>& stills) {
  const Duration span = stills.back().at - stills.front().at;
  if (span <= kLongestSpan) return;
  throw std::runtime_error(
      fmt::format("the pictures were taken over {:.1f} days ({} to {}): import each flight by itself",
                  seconds(span) / 86400.0, stills.front().named.file.filename().string(),
                  stills.back().named.file.filename().string()));
}

}  // namespace

FlightPlan plan_flight(std::vector<NamedStill> stills, const FlightFacts& facts) {
  FlightPlan plan;
  leave_out_unless(stills, "tells no time", plan.left_out,
                   [](const NamedStill& named) { return named.still.taken.has_value(); });
  keep_one_camera(stills, facts, plan);
  if (stills.empty()) return plan;
  const std::optional<io::Lens> usual_lens = most_common_lens(stills);
  const std::vector<TimedStill> timed =
      in_order_of_time(std::move(stills), facts.utc_offset_h, plan.assumptions);
  refuse_long_span(timed);
  const FlightHeights heights =
      heights_of(timed, {facts.take_off_height_m, facts.marks_height_m}, plan.assumptions);
  plan.take_off_height_m = heights.take_off_absolute_m;
  note_heights(timed, plan);
  note_rtk(timed, plan);
  assume_attitudes(timed, facts.camera_pitch_deg, plan);
  for (std::size_t i = 0; i < timed.size(); ++i) {
    Exposure exposure = exposure_of(timed[i], timed.front().at);
    exposure.focal_px = zoomed_focal_px(timed[i].named.still, usual_lens, plan.camera);
    exposure.position.height_above_home_m = heights.above_take_off_m[i];
    exposure.position.height_msl_m = heights.above_take_off_m[i] + heights.take_off_msl_m.value_or(0.0);
    plan.exposures.push_back(std::move(exposure));
  }
  note_zoom(plan);
  take_velocities(plan.exposures);
  take_courses(plan.exposures, timed);
  return plan;
}

}  // namespace geoloc::apps
