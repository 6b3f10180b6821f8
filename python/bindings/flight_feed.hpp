// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <variant>
#include <vector>

#include "geoloc/geoloc.hpp"

namespace geoloc::python {

/// A Geolocator whose samples wait for a frame of their time: what comes in arrays may be a whole flight of
/// one kind, and the estimator keeps a few seconds.
class FlightFeed {
 public:
  /// Frames that wait no longer.
  using Outcomes = std::vector<FrameOutcome>;

  explicit FlightFeed(const GeolocatorConfig& config) : geolocator_(config) {}

  template <typename Sample>
  void expect(const Sample& sample) {
    expected_.emplace(sample.time, sample);
  }
  std::size_t samples_waiting() const { return expected_.size(); }

  Outcomes process(const FrameDetections& frame) {
    Outcomes outcomes;
    feed_until(frame.captured_at + kAhead, outcomes);
    if (const auto gone = geolocator_.add(frame)) outcomes.push_back(*gone);
    process_all(FrameWait::kForTelemetry, outcomes);
    newest_frame_ = frame.captured_at;
    return outcomes;
  }

  /// As after telemetry has come.
  Outcomes process_waiting() {
    Outcomes outcomes;
    if (newest_frame_) feed_until(*newest_frame_ + kAhead, outcomes);
    process_all(FrameWait::kForTelemetry, outcomes);
    return outcomes;
  }

  Outcomes finish() {
    Outcomes outcomes;
    feed_until(VehicleTime::max(), outcomes);
    process_all(FrameWait::kNoLonger, outcomes);
    geolocator_.finish();
    return outcomes;
  }

  Outcomes on_vehicle_reboot() {
    Outcomes outcomes;
    feed_until(VehicleTime::max(), outcomes);
    geolocator_.on_vehicle_reboot();
    newest_frame_.reset();
    return outcomes;
  }

  const Geolocator& geolocator() const { return geolocator_; }

 private:
  using Sample = std::variant<AttitudeSample, PositionSample, GimbalSample, RangeSample, FieldOfViewSample>;

  /// So much telemetry after a frame is fed with it.
  static constexpr Duration kAhead = std::chrono::seconds{1};

  /// Samples in the order of their times, and the frames that waited for them.
  void feed_until(VehicleTime end, Outcomes& outcomes) {
    while (!expected_.empty() && expected_.begin()->first <= end) {
      std::visit([&](const auto& sample) { geolocator_.add(sample); }, expected_.begin()->second);
      expected_.erase(expected_.begin());
      process_all(FrameWait::kForTelemetry, outcomes);
    }
  }

  void process_all(FrameWait wait, Outcomes& outcomes) {
    while (const auto processed = geolocator_.process_next(wait)) outcomes.push_back(*processed);
  }

  Geolocator geolocator_;
  std::multimap<VehicleTime, Sample> expected_;  // not fed yet
  std::optional<VehicleTime> newest_frame_;
};

}  // namespace geoloc::python
