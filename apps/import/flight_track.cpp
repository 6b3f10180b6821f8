// SPDX-License-Identifier: Apache-2.0
#include "import/flight_track.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "geoloc/geometry/angles.hpp"
#include "import/track_heights.hpp"
#include "import/track_motion.hpp"

namespace geoloc::apps {
namespace {

using namespace std::chrono_literals;

/// Telemetry's clock holds 49 days; no vehicle flies for one.
constexpr Duration kLongestLog = 24h;

/// The median: single times are late by what the log took to be written.
Duration utc_since(const std::vector<io::UtcPair>& pairs) {
  std::vector<Duration> offsets;
  offsets.reserve(pairs.size());
  for (const io::UtcPair& pair : pairs)
    offsets.push_back(pair.utc.time_since_epoch() - pair.time.time_since_epoch());
  const auto middle = offsets.begin() + static_cast<std::ptrdiff_t>(offsets.size() / 2);
  std::nth_element(offsets.begin(), middle, offsets.end());
  return *middle;
}

void take_utc(const io::FlightLog& log, std::optional<double> utc_offset_h, FlightTrack& track) {
  track.is_utc_known = !log.utc.empty();
  if (!track.is_utc_known) {
    constexpr Duration kSecondDay = 24h;  // a video may begin before its log
    track.utc_since_log = kSecondDay - track.begin.time_since_epoch();
    track.assumptions.emplace_back("the log tells no date: in the results it begins on 2 January 1970");
    return;
  }
  track.utc_since_log = utc_since(log.utc);
  if (!log.is_utc_local) return;
  track.utc_since_log -= from_seconds(3600.0 * utc_offset_h.value_or(0.0));
  if (!utc_offset_h)
    track.assumptions.emplace_back(
        "the log does not tell its time zone: UTC is assumed (--utc-offset-h says another)");
}

/// A gimbal that keeps its pitch and looks where the vehicle heads.
std::vector<io::LoggedGimbal> level_gimbal(const std::vector<AttitudeSample>& attitudes, double pitch_deg) {
  std::vector<io::LoggedGimbal> gimbal;
  gimbal.reserve(attitudes.size());
  for (const AttitudeSample& attitude : attitudes)
    gimbal.push_back(
        {attitude.time, {0.0, pitch_deg * kRadPerDeg, attitude.angles.yaw_rad}, GimbalYaw::kFromNorth});
  return gimbal;
}

/// Only the camera's own angles count where the vehicle's are not told: it is taken to be level, to the
/// north, and its camera turns below it. No watch then takes a turn of the camera for a jump of the vehicle.
template <typename Sample>
std::vector<AttitudeSample> level_north(const std::vector<Sample>& samples) {
  std::vector<AttitudeSample> attitudes;
  attitudes.reserve(samples.size());
  for (const Sample& sample : samples) attitudes.push_back({sample.time, {}});
  return attitudes;
}

/// How the camera looked, where the log has no angle of a gimbal.
void assume_camera(const TrackFacts& facts, FlightTrack& track) {
  constexpr double kToldSigma_deg = 2.0, kNadirSigma_deg = 5.0, kNadir_deg = -90.0;
  track.is_heading_assumed = true;
  track.assumed_gimbal =
      level_gimbal(level_towards_course(track.positions), facts.camera_pitch_deg.value_or(kNadir_deg));
  track.attitudes = level_north(track.assumed_gimbal);
  track.sigma_attitude_deg = facts.camera_pitch_deg ? kToldSigma_deg : kNadirSigma_deg;
  track.assumptions.push_back(fmt::format(
      "the log does not tell how the camera looked: it is taken to look {}, to {:g} degrees{}",
      facts.camera_pitch_deg ? fmt::format("with a pitch of {:g} degrees", *facts.camera_pitch_deg)
                             : std::string("straight down"),
      track.sigma_attitude_deg, facts.camera_pitch_deg ? "" : " (--gimbal-pitch-deg says another pitch)"));
  track.assumptions.emplace_back(
      "the log tells no heading: the image's top is taken to be where the vehicle flew to");
}

void take_angles(io::FlightLog& log, const TrackFacts& facts, FlightTrack& track) {
  track.attitudes = std::move(log.attitudes);
  track.gimbal = std::move(log.gimbal);
  const bool has_nose_yaws = std::any_of(track.gimbal.begin(), track.gimbal.end(), [](const auto& sample) {
    return sample.yaw == GimbalYaw::kFromNose;
  });
  if (track.attitudes.empty() && has_nose_yaws) track.gimbal.clear();
  if (track.attitudes.empty() && track.gimbal.empty()) return assume_camera(facts, track);
  if (track.attitudes.empty()) track.attitudes = level_north(track.gimbal);
  if (!track.gimbal.empty()) {
    if (facts.camera_pitch_deg)
      track.assumptions.emplace_back("--gimbal-pitch-deg is not used: the log tells how the camera looked");
    return;
  }
  if (!facts.camera_pitch_deg) return;  // fixed in the vehicle
  track.assumed_gimbal = level_gimbal(track.attitudes, *facts.camera_pitch_deg);
  track.assumptions.emplace_back(
      "the log has no angles of a gimbal: the camera is taken to keep the pitch of --gimbal-pitch-deg, "
      "level, "
      "towards the vehicle's nose");
}

void note_damage(const io::FlightLog& log, FlightTrack& track) {
  if (log.skipped_bytes > 0)
    track.notes.push_back(
        fmt::format("the log is damaged: {} bytes of it are no records", log.skipped_bytes));
  if (log.dropouts > 0) track.notes.push_back(fmt::format("the log reports {} gaps in it", log.dropouts));
}

}  // namespace

FlightTrack track_of(io::FlightLog log, const TrackFacts& facts) {
  FlightTrack track;
  track.assumptions = log.assumptions;
  note_damage(log, track);
  track.positions = positions_above_home(log, facts.take_off_height_m, track.assumptions);
  drop_held_positions(track.positions);
  take_out_rounding(track.positions, track.notes);
  take_velocities(log.velocities, track.positions);
  take_angles(log, facts, track);
  track.fixes = std::move(log.fixes);
  track.begin = std::min(track.positions.front().time, track.attitudes.front().time);
  track.end = std::max(track.positions.back().time, track.attitudes.back().time);
  take_utc(log, facts.utc_offset_h, track);
  if (track.end - track.begin > kLongestLog)
    throw std::runtime_error(
        fmt::format("spans {:.1f} days: cut out the flight", seconds(track.end - track.begin) / 86400.0));
  return track;
}

}  // namespace geoloc::apps
