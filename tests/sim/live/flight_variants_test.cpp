// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/live/flight_variants.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/io/mavlink/frame_parser.hpp"
#include "geoloc/io/mavlink/messages.hpp"
#include "sim/flights_for_test.hpp"

namespace geoloc::sim {
namespace {

/// What a receiver understands of a flight's telemetry.
struct Heard {
  std::vector<AttitudeSample> attitudes;
  std::vector<PositionSample> positions;
  std::size_t frames = 0;
};

Heard hear(const Flight& flight) {
  Heard heard;
  io::FrameParser parser;
  for (const io::TlogRecord& record : flight.telemetry.records()) {
    parser.append(record.frame, record.size);
    while (const auto frame = parser.next()) {
      ++heard.frames;
      const io::Message message = io::decode(*frame);
      if (const auto* attitude = std::get_if<io::AttitudeMessage>(&message)) {
        if (!attitude->from_quaternion) heard.attitudes.push_back(attitude->sample);
      }
      if (const auto* position = std::get_if<PositionSample>(&message)) heard.positions.push_back(*position);
    }
  }
  return heard;
}

template <typename Sample>
double rate_hz(const std::vector<Sample>& samples) {
  return static_cast<double>(samples.size() - 1) / seconds(samples.back().time - samples.front().time);
}

template <typename Sample>
bool is_in_order(const std::vector<Sample>& samples) {
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (!(samples[i].time > samples[i - 1].time)) return false;
  }
  return true;
}

/// Horizontal and vertical RMS [m] of the reported positions about the truth.
Eigen::Vector2d position_error_m(const Flight& flight, const Heard& heard) {
  Eigen::Vector2d squares = Eigen::Vector2d::Zero();
  int count = 0;
  for (const PositionSample& sample : heard.positions) {
    const auto pose = flight.truth.pose(sample.time);
    if (!pose) continue;
    const Eigen::Vector2d told = flight.truth.frame().to_local(sample.position).position_in_enu;
    squares.x() += (told - pose->translation.head<2>()).squaredNorm();
    squares.y() += std::pow(sample.height_above_home_m - pose->translation.z(), 2);
    ++count;
  }
  return (squares / count).cwiseSqrt();
}

double yaw_error_rad(const Flight& flight, const Heard& heard) {
  double squares = 0.0;
  int count = 0;
  for (const AttitudeSample& sample : heard.attitudes) {
    const auto pose = flight.truth.pose(sample.time);
    if (!pose) continue;
    const double true_yaw_rad = euler_angles(enu_from_ned() * pose->rotation).yaw_rad;
    squares += std::pow(wrap_to_pi(sample.angles.yaw_rad - true_yaw_rad), 2);
    ++count;
  }
  return std::sqrt(squares / count);
}

class TelemetryRate : public ::testing::TestWithParam<double> {};

TEST_P(TelemetryRate, IsAsAskedInOrderAndAsAccurateAsRecorded) {
  const Flight recorded = load("stock_path3");
  const Flight flight = at_telemetry_rate(recorded, GetParam());
  const Heard before = hear(recorded), heard = hear(flight);
  EXPECT_NEAR(rate_hz(heard.attitudes) / GetParam(), 1.0, 0.02);
  EXPECT_NEAR(rate_hz(heard.positions) / GetParam(), 1.0, 0.02);
  EXPECT_TRUE(is_in_order(heard.attitudes));
  EXPECT_TRUE(is_in_order(heard.positions));
  EXPECT_EQ(flight.telemetry.skipped_bytes(), 0U);
  EXPECT_EQ(heard.frames, flight.telemetry.records().size()) << "a checksum is wrong";
  const Eigen::Vector2d difference_m = position_error_m(flight, heard) - position_error_m(recorded, before);
  EXPECT_LT(difference_m.cwiseAbs().maxCoeff(), 0.01);
  EXPECT_NEAR(yaw_error_rad(flight, heard), yaw_error_rad(recorded, before), 0.05 * kRadPerDeg);
}

INSTANTIATE_TEST_SUITE_P(FewerAndMore, TelemetryRate, ::testing::Values(2.0, 3.0, 5.0, 10.0, 20.0, 50.0));

TEST(FlightVariants, AtTheRecordedRateEveryMessageIsKept) {
  const Flight recorded = load("stock_path1");
  const Heard before = hear(recorded), heard = hear(at_telemetry_rate(recorded, 10.0));
  ASSERT_EQ(heard.attitudes.size(), before.attitudes.size());
  for (std::size_t i = 0; i < before.attitudes.size(); ++i) {
    ASSERT_EQ(heard.attitudes[i].time, before.attitudes[i].time);
    ASSERT_EQ(heard.attitudes[i].angles.yaw_rad, before.attitudes[i].angles.yaw_rad);
  }
}

TEST(FlightVariants, RaisingMovesTruthAndTelemetryTogetherAndKeepsTheSurvey) {
  const Flight recorded = load("gnss_path2");
  const Flight flight = raised(recorded, 100.0);
  const Heard before = hear(recorded), heard = hear(flight);
  ASSERT_EQ(heard.positions.size(), before.positions.size());
  EXPECT_NEAR(heard.positions[900].height_above_home_m - before.positions[900].height_above_home_m, 100.0,
              1e-6);
  EXPECT_NEAR(*heard.positions[900].height_msl_m - *before.positions[900].height_msl_m, 100.0, 1e-6);
  EXPECT_LT((position_error_m(flight, heard) - position_error_m(recorded, before)).cwiseAbs().maxCoeff(),
            1e-6);
  EXPECT_EQ(flight.truth.survey().begin, recorded.truth.survey().begin);
  EXPECT_EQ(flight.truth.survey().end, recorded.truth.survey().end);
}

class AddedNoise : public ::testing::TestWithParam<double> {};

TEST_P(AddedNoise, HasTheSigmaAndTheTimeConstantAskedFor) {
  constexpr double kSigma_deg = 1.2;
  const Flight recorded = load("stock_path1");
  const Heard before = hear(recorded);
  const Heard heard = hear(with_attitude_noise(recorded, {kSigma_deg, GetParam(), 5}));
  ASSERT_EQ(heard.attitudes.size(), before.attitudes.size());
  double squares = 0.0, products = 0.0, last_rad = 0.0;
  for (std::size_t i = 0; i < before.attitudes.size(); ++i) {
    const double error_rad =
        wrap_to_pi(heard.attitudes[i].angles.yaw_rad - before.attitudes[i].angles.yaw_rad);
    squares += error_rad * error_rad;
    products += error_rad * last_rad;
    last_rad = error_rad;
  }
  const double pause_s = 0.1, kept = GetParam() > 0.0 ? std::exp(-pause_s / GetParam()) : 0.0;
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(before.attitudes.size())) / kRadPerDeg, kSigma_deg,
              0.2 * kSigma_deg);
  EXPECT_NEAR(products / squares, kept, 0.05);
}

INSTANTIATE_TEST_SUITE_P(WhiteAndSlow, AddedNoise, ::testing::Values(0.0, 0.5, 4.0));

class Speed : public ::testing::TestWithParam<double> {};

TEST_P(Speed, DividesEveryTimeAndKeepsErrorsInMetres) {
  const Flight recorded = load("stock_path2");
  const Flight flight = at_speed(recorded, GetParam());
  const Heard before = hear(recorded), heard = hear(flight);
  ASSERT_EQ(heard.positions.size(), before.positions.size());
  const double length_s = seconds(recorded.truth.survey().end - recorded.truth.survey().begin);
  EXPECT_NEAR(seconds(flight.truth.survey().end - flight.truth.survey().begin), length_s / GetParam(), 1e-6);
  EXPECT_NEAR(rate_hz(heard.positions), GetParam() * rate_hz(before.positions), 0.1);
  // Stamps are whole milliseconds, cut off: at 20 m/s that is up to 2 cm.
  EXPECT_LT((position_error_m(flight, heard) - position_error_m(recorded, before)).cwiseAbs().maxCoeff(),
            0.02);
}

INSTANTIATE_TEST_SUITE_P(SlowAndFast, Speed, ::testing::Values(0.4, 1.0, 4.0));

}  // namespace
}  // namespace geoloc::sim
