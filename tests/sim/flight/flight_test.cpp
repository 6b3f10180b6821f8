// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/flight/flight.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "geoloc/sim/flight/mavlink_frame.hpp"
#include "sim/flights_for_test.hpp"
#include "support/source_tree.hpp"

namespace geoloc::sim {
namespace {

constexpr std::uint32_t kGlobalPositionIntId = 33;

/// Horizontal distance [m] of every position the autopilot reported to where the vehicle truly was then.
std::vector<double> position_errors_m(const Flight& flight) {
  std::vector<double> errors_m;
  for (const io::TlogRecord& record : flight.telemetry.records()) {
    const auto frame = view_frame(record.frame, record.size);
    if (!frame || frame->message_id != kGlobalPositionIntId) continue;
    const VehicleTime time{std::chrono::milliseconds{load_u32(frame->payload)}};
    const Geodetic reported{static_cast<std::int32_t>(load_u32(frame->payload + 4)) * 1e-7,
                            static_cast<std::int32_t>(load_u32(frame->payload + 8)) * 1e-7};
    const auto pose = flight.truth.pose(time);
    if (!pose) continue;
    const Eigen::Vector2d reported_in_enu = flight.truth.frame().to_local(reported).position_in_enu;
    errors_m.push_back((reported_in_enu - pose->translation.head<2>()).norm());
  }
  return errors_m;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

TEST(Flight, TelemetryAgreesWithTruthAsWellAsTheReadmeSays) {
  const auto stock = position_errors_m(load("stock_path2"));
  ASSERT_GT(stock.size(), 2000U);
  EXPECT_LT(mean(stock), 0.2);
  EXPECT_LT(mean(position_errors_m(load("gnss_path3"))), 1.3);
}

TEST(Flight, StampsAndVehicleClockAreTied) {
  const Flight flight = load("stock_path1");
  std::vector<double> lags_s;
  for (const io::TlogRecord& record : flight.telemetry.records()) {
    const auto frame = view_frame(record.frame, record.size);
    if (!frame || frame->message_id != kAttitudeId) continue;
    const VehicleTime time{std::chrono::milliseconds{load_u32(frame->payload)}};
    lags_s.push_back(seconds(record.received_at - flight.host_time(time)));
    ASSERT_GE(lags_s.back(), 0.0);
  }
  EXPECT_LT(mean(lags_s), 0.001);
}

TEST(Flight, AllTwelveAreThereAndTheSamplesAreNotAmongThem) {
  const auto names = flight_names(flight_folder());
  ASSERT_EQ(names.size(), 12U);
  EXPECT_EQ(names.front(), "gnss_path1");
  EXPECT_EQ(names.back(), "stock_path6");
}

TEST(Flight, UnknownNameListsWhatThereIs) {
  try {
    load("stock_path7");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("stock_path7"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("gnss_path4"), std::string::npos);
  }
  EXPECT_THROW(load("../flights/stock_path1"), std::runtime_error);
}

TEST(Flight, FolderIsFoundFromTheProgramOrSaidToBeMissing) {
  const auto program = source_tree() / "build/release/bin/geoloc_sim";
  EXPECT_TRUE(std::filesystem::equivalent(find_flights(std::nullopt, program), flight_folder()));
  EXPECT_TRUE(
      std::filesystem::equivalent(find_flights(flight_folder(), "/nowhere/bin/geoloc_sim"), flight_folder()));
  EXPECT_THROW(find_flights("/nowhere", program), std::runtime_error);
}

TEST(MavlinkFrame, NeverReadsBeyondWhatIsThere) {
  const std::uint8_t whole[] = {0xFD, 1, 0, 0, 7, 3, 1, 30, 0, 0, 0x55, 0xAA, 0xBB};
  for (std::size_t size = 0; size < sizeof(whole); ++size) EXPECT_FALSE(view_frame(whole, size)) << size;
  const auto frame = view_frame(whole, sizeof(whole));
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->message_id, 30U);
  EXPECT_EQ(frame->system_id, 3);
  EXPECT_EQ(frame->payload_size, 1U);
  const std::uint8_t other[] = {0x7E, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_FALSE(view_frame(other, sizeof(other)));
}

}  // namespace
}  // namespace geoloc::sim
