// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/live/rangefinder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <variant>
#include <vector>

#include "geoloc/io/mavlink/frame_parser.hpp"
#include "geoloc/io/mavlink/messages.hpp"
#include "geoloc/sim/flight/mavlink_frame.hpp"
#include "sim/flights_for_test.hpp"

namespace geoloc::sim {
namespace {

std::vector<io::RangeMessage> hear(const Flight& flight) {
  std::vector<io::RangeMessage> heard;
  io::FrameParser parser;
  for (const io::TlogRecord& record : flight.telemetry.records()) {
    parser.append(record.frame, record.size);
    while (const auto frame = parser.next()) {
      const io::Message message = io::decode(*frame);
      if (const auto* range = std::get_if<io::RangeMessage>(&message)) heard.push_back(*range);
    }
  }
  return heard;
}

/// All but a few readings end on the ground, to a few times the noise that is stated.
TEST(SimulatedRangefinder, MeasuresTheGroundBelowTheVehicle) {
  const Terrain terrain{1.5, 0.0};
  const Flight recorded = load("stock_path1");
  const Flight flight = with_rangefinder(recorded, terrain, 3);
  const std::vector<io::RangeMessage> heard = hear(flight);
  ASSERT_GT(heard.size(), 1000U);
  std::size_t on_ground = 0;
  for (const io::RangeMessage& range : heard) {
    ASSERT_TRUE(range.time);
    const Rigid3d pose = flight.truth.pose(*range.time).value();
    const Eigen::Vector3d end = pose * Eigen::Vector3d(0.0, 0.0, range.distance_m);
    const double above_m = end.z() - terrain.height_above_home_m(end.head<2>());
    if (std::abs(above_m) < 0.2 + 0.05 * range.distance_m) ++on_ground;
  }
  EXPECT_GT(on_ground, heard.size() * 95 / 100);
  EXPECT_LT(on_ground, heard.size());
}

TEST(SimulatedRangefinder, ChangesNothingElseAndDependsOnTheSeed) {
  const Flight recorded = load("stock_path1");
  const Flight first = with_rangefinder(recorded, {}, 3), again = with_rangefinder(recorded, {}, 3);
  const Flight other = with_rangefinder(recorded, {}, 4);
  std::size_t others = 0;
  for (const io::TlogRecord& record : first.telemetry.records()) {
    constexpr std::uint32_t kDistanceSensor = 132;
    const auto frame = view_frame(record.frame, record.size);
    if (!frame || frame->message_id != kDistanceSensor) ++others;
  }
  EXPECT_EQ(others, recorded.telemetry.records().size());
  const auto distances = [](const Flight& flight) {
    std::vector<double> all;
    for (const io::RangeMessage& range : hear(flight)) all.push_back(range.distance_m);
    return all;
  };
  EXPECT_EQ(distances(first), distances(again));
  EXPECT_NE(distances(first), distances(other));
}

}  // namespace
}  // namespace geoloc::sim
