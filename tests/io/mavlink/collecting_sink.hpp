// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "geoloc/io/mavlink/telemetry_sink.hpp"
#include "io/mavlink/test_frames.hpp"

namespace geoloc::io::testing {

struct ReceivedFrame {
  HostTime at;
  Bytes bytes;
};

/// Keeps everything that a VehicleLink delivers.
class CollectingSink : public TelemetrySink {
 public:
  void on_attitude(const AttitudeSample& sample) override { attitudes.push_back(sample); }
  void on_position(const PositionSample& sample) override { positions.push_back(sample); }
  void on_range(const RangeSample& sample) override { ranges.push_back(sample); }
  void on_gimbal(const GimbalSample& sample) override { gimbals.push_back(sample); }
  void on_field_of_view(const FieldOfViewSample& sample) override { fields_of_view.push_back(sample); }
  void on_reboot() override {
    attitudes_before_reboot.push_back(attitudes.size());
    reboots_at.push_back(frames.back().at);
  }
  void on_other_vehicle() override { ++other_vehicles; }
  void on_clock_step(Duration change) override { clock_steps.push_back(change); }
  void on_frame(HostTime at, const std::uint8_t* frame, std::size_t size) override {
    frames.push_back({at, Bytes(frame, frame + size)});
  }

  std::vector<AttitudeSample> attitudes;
  std::vector<PositionSample> positions;
  std::vector<RangeSample> ranges;
  std::vector<GimbalSample> gimbals;
  std::vector<FieldOfViewSample> fields_of_view;
  std::vector<std::size_t> attitudes_before_reboot;
  std::vector<ReceivedFrame> frames;
  std::vector<HostTime> reboots_at;
  std::vector<Duration> clock_steps;
  int other_vehicles = 0;
};

}  // namespace geoloc::io::testing
