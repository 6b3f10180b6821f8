// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "geoloc/io/logs/flight_log.hpp"

// What the readers of logs share.
namespace geoloc::io {

/// The most samples of a kind: 100 Hz for eleven hours. More is no flight, and would take the computer's
/// memory.
constexpr std::size_t kMostSamples = 4'000'000;

constexpr double kVideoStartCommand = 2500.0;  // MAV_CMD_VIDEO_START_CAPTURE

template <typename Sample>
void keep(std::vector<Sample>& samples, Sample sample) {
  if (samples.size() >= kMostSamples)
    throw std::runtime_error("holds more samples than any flight (4 million of one kind)");
  samples.push_back(std::move(sample));
}

/// Where it is another than the one before.
inline void keep_focal_length(FlightLog& log, const LoggedFocalLength& told) {
  if (log.focal_lengths.empty() || log.focal_lengths.back().equivalent_mm != told.equivalent_mm)
    keep(log.focal_lengths, told);
}

/// Microseconds of a log's clock, as far as a clock goes: 292 years would overflow.
inline bool is_time_us(double time_us) {
  constexpr double kMost_us = 9e15;
  return time_us >= 0.0 && time_us <= kMost_us;
}

inline VehicleTime time_from_us(double time_us) {
  return VehicleTime{std::chrono::microseconds{std::llround(time_us)}};
}

/// Whether a vehicle may be there; nothing is known yet at 0, 0.
inline bool is_place(const Geodetic& position) {
  return is_valid(position) && !(position.latitude_deg == 0.0 && position.longitude_deg == 0.0);
}

template <typename Sample>
void sort_by_time(std::vector<Sample>& samples) {
  const auto is_earlier = [](const Sample& a, const Sample& b) { return a.time < b.time; };
  if (!std::is_sorted(samples.begin(), samples.end(), is_earlier))
    std::stable_sort(samples.begin(), samples.end(), is_earlier);
}

/// Where no estimator's positions are told, the receiver's stand for them.
inline void take_positions_of_fixes(FlightLog& log) {
  constexpr int kFix3d = 3;
  if (!log.positions.empty()) return;
  for (const LoggedFix& fix : log.fixes) {
    if (fix.fix_type >= kFix3d && is_place(fix.position))
      keep(log.positions, {fix.time, fix.position, {std::nullopt, fix.height_msl_m, std::nullopt}});
  }
  log.assumptions.emplace_back("the log has no filtered positions: they are the receiver's own");
}

/// The last thing that each reader does.
inline void finish(FlightLog& log) {
  take_positions_of_fixes(log);
  if (log.positions.empty())
    throw std::runtime_error("holds no position: the vehicle never knew where it was");
  sort_by_time(log.attitudes);
  sort_by_time(log.positions);
  sort_by_time(log.velocities);
  sort_by_time(log.fixes);
  sort_by_time(log.gimbal);
  sort_by_time(log.focal_lengths);
  sort_by_time(log.camera_events);
  sort_by_time(log.utc);
}

}  // namespace geoloc::io
