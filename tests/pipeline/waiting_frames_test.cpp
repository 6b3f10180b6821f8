// SPDX-License-Identifier: Apache-2.0
// What is promised of frames that are added before the telemetry around them has come.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <random>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include "geoloc/pipeline/geolocator.hpp"
#include "geoloc/state/state_provider.hpp"
#include "support/allocation_counter.hpp"
#include "support/nadir_flight.hpp"

namespace geoloc {
namespace {

using testing::at_s;
using testing::attitude_sample;
using testing::Pose;
using testing::position_sample;

const std::vector<Eigen::Vector2d> kPlaces{{-6, 2}, {4, 5}, {-3, 9}, {6, 13}, {0, 17}};

Pose northwards_in_gusts(double time_s) {
  return {{0.0, 4.0 * time_s, 20.0}, 0.06 * std::sin(3.0 * time_s), 0.04 * std::sin(5.0 * time_s), 0.1};
}

FrameDetections frame_at(double time_s, const testing::Path& path = northwards_in_gusts) {
  FrameDetections frame;
  frame.captured_at = at_s(time_s);
  frame.captured_at_host = testing::host_at_s(time_s);
  for (const Eigen::Vector2d& place : kPlaces) {
    const auto pixel = testing::pixel_of(place, path(time_s));
    if (pixel && std::abs(pixel->x() - 640.0) < 600.0 && std::abs(pixel->y() - 360.0) < 320.0)
      frame.detections.push_back(testing::box_at(*pixel));
  }
  return frame;
}

void add_telemetry(Geolocator& geolocator, double begin_s, double end_s, double period_s = 0.1) {
  for (double time_s = begin_s; time_s < end_s; time_s += period_s) {
    geolocator.add(position_sample(time_s, northwards_in_gusts(time_s)));
    geolocator.add(attitude_sample(time_s, northwards_in_gusts(time_s)));
  }
}

std::vector<FrameOutcome> process_all(Geolocator& geolocator, FrameWait wait = FrameWait::kForTelemetry) {
  std::vector<FrameOutcome> outcomes;
  while (const auto outcome = geolocator.process_next(wait)) outcomes.push_back(*outcome);
  return outcomes;
}

FrameFate fate_of_only(Geolocator& geolocator, FrameWait wait = FrameWait::kForTelemetry) {
  const auto outcomes = process_all(geolocator, wait);
  EXPECT_EQ(outcomes.size(), 1U);
  return outcomes.at(0).fate;
}

// --- However telemetry and frames come, the result is that of knowing all telemetry beforehand.

struct Event {
  double arrives_s;
  std::variant<AttitudeSample, PositionSample, FrameDetections> what;
};

struct Regime {
  double attitude_hz, position_hz, frame_hz;
  double telemetry_lag_s;              ///< from a sample's time to its arrival
  double frame_lag_s, frame_jitter_s;  ///< the same of frames; none comes later than the telemetry around it
};

void PrintTo(const Regime& regime, std::ostream* out) {
  *out << regime.attitude_hz << " and " << regime.position_hz << " Hz, " << regime.frame_hz
       << " frames per second, late by " << regime.telemetry_lag_s << " s and " << regime.frame_lag_s
       << " to " << regime.frame_lag_s + regime.frame_jitter_s << " s";
}

constexpr double kEnd_s = 4.0;

std::vector<Event> events_of(const Regime& regime, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> phase(0.0, 1.0);
  std::vector<Event> events;
  for (int i = 0; i / regime.attitude_hz <= kEnd_s; ++i) {
    const double time_s = i / regime.attitude_hz;
    events.push_back({time_s + regime.telemetry_lag_s, attitude_sample(time_s, northwards_in_gusts(time_s))});
  }
  const double position_phase_s = 0.5 * phase(random) / regime.position_hz;
  for (int i = 0; position_phase_s + i / regime.position_hz <= kEnd_s; ++i) {
    const double time_s = position_phase_s + i / regime.position_hz;
    events.push_back({time_s + regime.telemetry_lag_s, position_sample(time_s, northwards_in_gusts(time_s))});
  }
  for (double time_s = 0.2 + phase(random) / regime.frame_hz; time_s < kEnd_s - 0.3;
       time_s += 1.0 / regime.frame_hz) {
    events.push_back({time_s + regime.frame_lag_s + regime.frame_jitter_s * phase(random), frame_at(time_s)});
  }
  std::sort(events.begin(), events.end(),
            [](const Event& a, const Event& b) { return a.arrives_s < b.arrives_s; });
  return events;
}

/// What is seen of a Geolocator after a frame.
using Seen = std::tuple<VehicleTime, std::vector<double>>;

Seen seen_after_frame(const Geolocator& geolocator) {
  const FrameView& view = geolocator.view();
  std::vector<double> numbers;
  for (int i = 0; i < 3; ++i) numbers.push_back(view.enu_from_camera.translation[i]);
  for (int i = 0; i < 4; ++i) numbers.push_back(view.enu_from_camera.rotation.coeffs()[i]);
  for (int i = 0; i < 3; ++i) numbers.push_back(view.vehicle.velocity_in_enu[i]);
  for (const LocatedDetection& located : geolocator.located()) {
    numbers.push_back(located.fix.position_in_enu.x());
    numbers.push_back(located.fix.position_in_enu.y());
  }
  for (const Track& track : geolocator.tracks()) {
    numbers.push_back(static_cast<double>(track.id));
    numbers.push_back(track.position_in_enu.mean.x());
    numbers.push_back(track.position_in_enu.mean.y());
    numbers.push_back(track.position_in_enu.covariance.trace());
  }
  return {view.vehicle.time, numbers};
}

std::vector<Seen> seen_as_they_come(const GeolocatorConfig& config, const std::vector<Event>& events) {
  Geolocator geolocator(config);
  std::vector<Seen> seen;
  const auto note_processed = [&](FrameWait wait) {
    while (const auto outcome = geolocator.process_next(wait)) {
      EXPECT_TRUE(outcome->is_located()) << explain(outcome->fate);
      seen.push_back(seen_after_frame(geolocator));
    }
  };
  for (const Event& event : events) {
    std::visit([&](const auto& what) { geolocator.add(what); }, event.what);
    note_processed(FrameWait::kForTelemetry);
  }
  note_processed(FrameWait::kNoLonger);
  EXPECT_EQ(geolocator.frames_waiting(), 0U);
  return seen;
}

std::vector<Seen> seen_by_telemetry_first(const GeolocatorConfig& config, const std::vector<Event>& events) {
  Geolocator geolocator(config);
  std::vector<FrameDetections> frames;
  for (const Event& event : events) {
    if (const auto* attitude = std::get_if<AttitudeSample>(&event.what)) geolocator.add(*attitude);
    if (const auto* position = std::get_if<PositionSample>(&event.what)) geolocator.add(*position);
    if (const auto* frame = std::get_if<FrameDetections>(&event.what)) frames.push_back(*frame);
  }
  std::sort(frames.begin(), frames.end(),
            [](const auto& a, const auto& b) { return a.captured_at < b.captured_at; });
  std::vector<Seen> seen;
  for (const FrameDetections& frame : frames) {
    EXPECT_TRUE(geolocator.process(frame));
    seen.push_back(seen_after_frame(geolocator));
  }
  return seen;
}

class WaitingFrames : public ::testing::TestWithParam<Regime> {};

TEST_P(WaitingFrames, AreLocatedOnceAndAsIfAllTelemetryHadComeFirst) {
  for (const Method method : {Method::kPaper, Method::kJoint}) {
    GeolocatorConfig config;
    config.method = method;
    for (const unsigned seed : {1U, 2U, 3U}) {
      const auto events = events_of(GetParam(), seed);
      const auto expected = seen_by_telemetry_first(config, events);
      EXPECT_GE(expected.size(), 30U);
      EXPECT_EQ(seen_as_they_come(config, events), expected) << static_cast<int>(method) << ' ' << seed;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Rates, WaitingFrames,
    ::testing::Values(Regime{10, 10, 10, 0.0, 0.1, 0.0},  // late by 0.1 s, in order
                      Regime{5, 5, 10, 0.0, 0.0, 0.0}, Regime{23, 7, 15, 0.05, 0.3, 0.0},
                      Regime{100, 50, 30, 0.0, 0.02, 0.0},
                      Regime{10, 5, 10, 0.5, 0.0, 0.5},  // out of order, before telemetry
                      Regime{50, 25, 15, 0.8, 0.0, 0.8}, Regime{100, 100, 30, 0.3, 0.0, 0.3}));

// --- What becomes of those that cannot be located.

TEST(FrameFate, OfAFrameFromBeforeTheTelemetryIsTold) {
  Geolocator geolocator{GeolocatorConfig{}};
  geolocator.add(frame_at(0.5));
  EXPECT_TRUE(process_all(geolocator).empty()) << "telemetry may yet come";
  add_telemetry(geolocator, 1.0, 2.0);
  EXPECT_EQ(fate_of_only(geolocator), FrameFate::kBeforeTelemetry);
}

TEST(FrameFate, OfAFrameInAGapIsTold) {
  Geolocator geolocator{GeolocatorConfig{}};
  add_telemetry(geolocator, 0.0, 1.0);
  geolocator.add(frame_at(3.0));
  EXPECT_TRUE(process_all(geolocator).empty());
  add_telemetry(geolocator, 5.0, 6.0);
  EXPECT_EQ(fate_of_only(geolocator), FrameFate::kInAGap);
}

TEST(FrameFate, OfAFrameThatTelemetryDoesNotReachIsToldOnceTheCallerWaitsNoLonger) {
  Geolocator geolocator{GeolocatorConfig{}};
  add_telemetry(geolocator, 0.0, 1.0);
  geolocator.add(frame_at(1.5));
  EXPECT_TRUE(process_all(geolocator).empty());
  EXPECT_EQ(fate_of_only(geolocator, FrameWait::kNoLonger), FrameFate::kAfterTelemetry);
}

TEST(FrameFate, OfAFrameThatComesAfterALaterOneWasLocatedIsTold) {
  Geolocator geolocator{GeolocatorConfig{}};
  add_telemetry(geolocator, 0.0, 2.0);
  geolocator.add(frame_at(1.0));
  EXPECT_EQ(fate_of_only(geolocator), FrameFate::kLocated);
  for (const double time_s : {0.9, 1.0}) {
    geolocator.add(frame_at(time_s));
    EXPECT_EQ(fate_of_only(geolocator), FrameFate::kOutOfOrder) << time_s;
  }
  geolocator.add(frame_at(1.1));
  EXPECT_EQ(fate_of_only(geolocator), FrameFate::kLocated);
}

TEST(FrameFate, OfFramesThatWaitWhileTheVehiclesClockBeginsAnewIsTold) {
  for (const bool is_told : {true, false}) {
    Geolocator geolocator{GeolocatorConfig{}};
    add_telemetry(geolocator, 100.0, 101.0);
    geolocator.add(frame_at(100.5));
    EXPECT_EQ(fate_of_only(geolocator), FrameFate::kLocated);
    geolocator.add(frame_at(102.0));
    if (is_told) geolocator.on_vehicle_reboot();
    add_telemetry(geolocator, 0.0, 1.0);
    EXPECT_EQ(fate_of_only(geolocator), FrameFate::kClockBegunAnew);
    geolocator.add(frame_at(0.7));
    EXPECT_EQ(fate_of_only(geolocator), FrameFate::kLocated) << "earlier than one before, by another clock";
  }
}

TEST(FrameFate, OfFramesWithoutAnyTelemetryIsToldOnceTooManyWait) {
  Geolocator geolocator{GeolocatorConfig{}};
  std::vector<FrameOutcome> outcomes;
  for (int i = 0; i < 100; ++i) {
    EXPECT_FALSE(geolocator.add(frame_at(0.1 * i)));
    for (const FrameOutcome& outcome : process_all(geolocator)) outcomes.push_back(outcome);
  }
  EXPECT_GE(outcomes.size(), 100U - 64U);
  for (const FrameOutcome& outcome : outcomes) EXPECT_EQ(outcome.fate, FrameFate::kNoTelemetry);
}

/// Frames on another clock wait for a time that never comes: they must not keep others from being located.
TEST(FrameFate, OfFramesFarAheadIsNotThatOfOthers) {
  Geolocator geolocator{GeolocatorConfig{}};
  std::vector<FrameFate> fates;
  for (int i = 0; i < 200; ++i) {
    add_telemetry(geolocator, 0.1 * i, 0.1 * i + 0.05);
    geolocator.add(frame_at(1e8 + 0.1 * i));
    geolocator.add(frame_at(0.1 * i + 0.05));
    for (const FrameOutcome& outcome : process_all(geolocator)) {
      const bool is_ahead = outcome.captured_at > at_s(1e6);
      EXPECT_EQ(outcome.fate, is_ahead ? FrameFate::kAfterTelemetry : FrameFate::kLocated);
    }
  }
  EXPECT_GE(geolocator.counters().frames_located, 198U);
}

TEST(FrameFate, OfFramesThatNobodyProcessesIsReturnedByAdd) {
  Geolocator geolocator{GeolocatorConfig{}};
  add_telemetry(geolocator, 0.0, 10.0);
  for (int i = 0; i < 64; ++i) ASSERT_FALSE(geolocator.add(frame_at(0.1 + 0.1 * i)));
  const auto latest = geolocator.add(frame_at(7.0));
  ASSERT_TRUE(latest);
  EXPECT_EQ(latest->fate, FrameFate::kNoRoom);
  EXPECT_EQ(latest->captured_at, at_s(7.0));
  const auto before = geolocator.add(frame_at(0.05));
  ASSERT_TRUE(before);
  EXPECT_EQ(before->captured_at, at_s(0.1 + 0.1 * 63));
  EXPECT_EQ(process_all(geolocator).size(), 64U);
}

TEST(FrameFate, IsExplainedInASentence) {
  for (std::size_t fate = 0; fate < kFrameFates; ++fate) {
    const std::string text = explain(static_cast<FrameFate>(fate));
    EXPECT_GT(text.size(), 10U);
    EXPECT_EQ(text.back(), '.');
  }
}

TEST(WaitingFramesTogether, AreProcessedByFinish) {
  Geolocator geolocator{GeolocatorConfig{}};
  add_telemetry(geolocator, 0.0, 1.05);
  for (const double time_s : {0.5, 1.0, 1.5}) geolocator.add(frame_at(time_s));
  geolocator.finish();
  EXPECT_EQ(geolocator.frames_waiting(), 0U);
  EXPECT_EQ(geolocator.counters().frames_located, 2U) << "one of them at the time of the newest sample";
  EXPECT_EQ(geolocator.counters().frames_by_fate[static_cast<std::size_t>(FrameFate::kAfterTelemetry)], 1U);
}

/// Whatever comes, in whatever order: the number of frames is kept, and all room is made at construction.
TEST(WaitingFramesTogether, AreEachToldOfOnceWhateverComes) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> anywhere(-1.0, 12.0);
    Geolocator geolocator{GeolocatorConfig{}};
    std::vector<FrameDetections> frames;
    for (int i = 0; i < 300; ++i)
      frames.push_back(frame_at(random() % 20 == 0 ? 1e8 * anywhere(random) : anywhere(random)));
    add_telemetry(geolocator, 0.0, 0.25);  // sets the local frame, which is allocated
    const std::size_t before = testing::allocations();
    std::size_t told = 0;
    for (const FrameDetections& frame : frames) {
      const double time_s = anywhere(random);
      if (random() % 2 == 0) geolocator.add(position_sample(time_s, northwards_in_gusts(time_s)));
      if (random() % 2 == 0) geolocator.add(attitude_sample(time_s, northwards_in_gusts(time_s)));
      if (random() % 100 == 0) geolocator.on_vehicle_reboot();
      if (random() % 100 == 0) geolocator.on_vehicle_clock_step();
      if (geolocator.add(frame)) ++told;
      while (random() % 3 != 0) {
        if (geolocator.process_next(random() % 50 == 0 ? FrameWait::kNoLonger : FrameWait::kForTelemetry))
          ++told;
      }
      ASSERT_EQ(told, geolocator.counters().frames);
    }
    told += geolocator.frames_waiting();
    geolocator.finish();
    EXPECT_EQ(testing::allocations(), before);
    const Geolocator::Counters& counters = geolocator.counters();
    EXPECT_EQ(told, frames.size());
    EXPECT_EQ(counters.frames, frames.size());
    EXPECT_EQ(counters.frames_located + counters.frames_unusable, counters.frames);
    std::uint64_t by_fate = 0;
    for (const std::uint64_t count : counters.frames_by_fate) by_fate += count;
    EXPECT_EQ(by_fate, counters.frames);
  }
}

TEST(FrameStamps, WithoutAHostsTimeAreWorthThoseOfTheVehicle) {
  const auto seen = [](bool has_host_time) {
    Geolocator geolocator{GeolocatorConfig{}};
    add_telemetry(geolocator, 1.0, 5.0);
    for (double time_s = 1.1; time_s < 4.5; time_s += 0.1) {
      FrameDetections frame = frame_at(time_s);
      frame.captured_at_host = has_host_time ? HostTime{frame.captured_at.time_since_epoch()} : HostTime{};
      EXPECT_TRUE(geolocator.process(frame));
    }
    return seen_after_frame(geolocator);
  };
  EXPECT_EQ(seen(false), seen(true));
}

}  // namespace
}  // namespace geoloc
