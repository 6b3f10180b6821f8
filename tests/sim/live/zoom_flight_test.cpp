// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/live/zoom_flight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "sim/flights_for_test.hpp"
#include "sim/live/heard_messages.hpp"

namespace geoloc::sim {
namespace {

using HeardView = Heard<io::FieldOfViewMessage>;

std::vector<HeardView> hear_views(const Flight& flight) {
  return hear<io::FieldOfViewMessage>(flight);
}

double told_zoom(const HeardView& heard, const CameraIntrinsics& camera) {
  return 0.5 * camera.width_px / std::tan(0.5 * *heard.message.sample.horizontal_rad) / camera.fx_px;
}

/// But for the nominal value's error, its lag, and tenths of degrees.
TEST(SimulatedZoom, TellsWhatItSeesFiveTimesASecond) {
  const CameraIntrinsics camera = CameraIntrinsics::from_field_of_view(1280, 720, 70.0);
  const Flight flight = with_zoom(load("stock_path1"), {1.0, 4.0}, camera, 3);
  const std::vector<HeardView> heard = hear_views(flight);
  const TimeSpan span = flight.truth.span();
  EXPECT_NEAR(static_cast<double>(heard.size()), 5.0 * seconds(span.end - span.begin), 2.0);
  const double nominal = told_zoom(heard.front(), camera);
  EXPECT_NEAR(nominal, 1.0, 0.04);
  double least = 10.0, most = 0.0;
  for (std::size_t i = 0; i < heard.size(); ++i) {
    const VehicleTime heard_at{heard[i].at - flight.booted_at};
    const VehicleTime told_at = span.begin + i * std::chrono::milliseconds{200};
    const double zoom = flight.zoom_at(told_at - std::chrono::milliseconds{50});
    EXPECT_NEAR(told_zoom(heard[i], camera) / nominal / zoom, 1.0, 0.01) << i;
    EXPECT_GE(heard_at - told_at, std::chrono::milliseconds{20});
    EXPECT_LE(heard_at - told_at, std::chrono::milliseconds{80});
    least = std::min(least, zoom);
    most = std::max(most, zoom);
  }
  EXPECT_EQ(least, 1.0);
  EXPECT_GT(most, 3.0);
  EXPECT_LE(most, 4.0);
}

TEST(SimulatedZoom, NeverRunsFasterThanItsMotors) {
  const Flight flight = with_zoom(load("stock_path3"), {1.0, 4.0}, CameraIntrinsics{}, 5);
  const TimeSpan span = flight.truth.span();
  constexpr double kPerSecond = 1.0 / 0.7;  // doublings
  for (VehicleTime time = span.begin; time < span.end; time += std::chrono::milliseconds{10})
    EXPECT_LE(
        std::abs(std::log2(flight.zoom_at(time + std::chrono::milliseconds{10}) / flight.zoom_at(time))),
        0.01 * kPerSecond + 1e-9);
}

TEST(SimulatedZoom, IsTheSameForTheSameSeed) {
  const Flight flown = load("stock_path1");
  const auto bytes = [&](std::uint64_t seed) {
    return hear_views(with_zoom(flown, {}, CameraIntrinsics{}, seed));
  };
  const auto first = bytes(1), again = bytes(1), other = bytes(2);
  ASSERT_EQ(first.size(), again.size());
  bool differs = false;
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].message.sample.horizontal_rad, again[i].message.sample.horizontal_rad);
    differs = differs || first[i].message.sample.horizontal_rad != other[i].message.sample.horizontal_rad;
  }
  EXPECT_TRUE(differs);
}

TEST(SimulatedZoom, RefusesWhatNoCameraDoes) {
  const Flight flown = load("stock_path1");
  for (const ZoomSettings& settings :
       {ZoomSettings{4.0, 1.0}, ZoomSettings{0.0, 2.0}, ZoomSettings{1.0, NAN}})
    EXPECT_THROW(with_zoom(flown, settings, CameraIntrinsics{}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace geoloc::sim
