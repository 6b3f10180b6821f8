// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/messages.hpp"

#include <gtest/gtest.h>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/attitude.hpp"
#include "geoloc/geometry/geodetic.hpp"
#include "geoloc/io/mavlink/frame_parser.hpp"
#include "geoloc/io/recording/tlog.hpp"
#include "io/mavlink/fixture_files.hpp"
#include "support/source_tree.hpp"

namespace geoloc::io {
namespace {

using Row = std::vector<std::string>;

VehicleTime boot_time(const std::string& time_boot_ms) {
  return VehicleTime{std::chrono::milliseconds{std::stoll(time_boot_ms)}};
}

/// Compares one decoded message with what pymavlink read in the same bytes.
class Comparison {
 public:
  explicit Comparison(const Row& row) : row_(row) {}

  void operator()(const NotDecoded&) const { EXPECT_EQ(row_[0], "OTHER"); }
  void operator()(const RefusedValues&) const { EXPECT_EQ(row_[0], "REFUSED"); }

  void operator()(const Heartbeat& found) const {
    ASSERT_EQ(row_[0], "HEARTBEAT");
    EXPECT_EQ(found.vehicle_type, std::stoi(row_[1]));
    EXPECT_EQ(found.autopilot, std::stoi(row_[2]));
  }

  void operator()(const AttitudeMessage& found) const {
    ASSERT_EQ(row_[0], found.from_quaternion ? "ATTITUDE_QUATERNION" : "ATTITUDE");
    EXPECT_EQ(found.sample.time, boot_time(row_[1]));
    const double tolerance = found.from_quaternion ? 1e-9 : 0.0;
    EXPECT_NEAR(found.sample.angles.roll_rad, std::stod(row_[2]), tolerance);
    EXPECT_NEAR(found.sample.angles.pitch_rad, std::stod(row_[3]), tolerance);
    EXPECT_NEAR(found.sample.angles.yaw_rad, std::stod(row_[4]), tolerance);
  }

  void operator()(const PositionSample& found) const {
    ASSERT_EQ(row_[0], "GLOBAL_POSITION_INT");
    EXPECT_EQ(found.time, boot_time(row_[1]));
    EXPECT_DOUBLE_EQ(found.position.latitude_deg * 1e7, std::stod(row_[2]));
    EXPECT_DOUBLE_EQ(found.position.longitude_deg * 1e7, std::stod(row_[3]));
    EXPECT_DOUBLE_EQ(*found.height_msl_m * 1e3, std::stod(row_[4]));
    EXPECT_DOUBLE_EQ(found.height_above_home_m * 1e3, std::stod(row_[5]));
  }

  /// The recorded vehicles have none.
  void operator()(const RangeMessage&) const { EXPECT_EQ(row_[0], "DISTANCE_SENSOR"); }
  void operator()(const FieldOfViewMessage&) const { EXPECT_EQ(row_[0], "CAMERA_FOV_STATUS"); }
  void operator()(const ZoomLevel&) const { EXPECT_EQ(row_[0], "CAMERA_SETTINGS"); }

  void operator()(const GimbalMessage& found) const {
    const char* const names[] = {"MOUNT_STATUS", "MOUNT_ORIENTATION", "GIMBAL_DEVICE_ATTITUDE_STATUS"};
    ASSERT_EQ(row_[0], names[static_cast<std::size_t>(found.source)]);
    EXPECT_EQ(found.has_time, found.source != GimbalSource::kMountStatus);
    EXPECT_EQ(found.sample.time, boot_time(row_[1]));
    const Eigen::Quaterniond expected(std::stod(row_[2]), std::stod(row_[3]), std::stod(row_[4]),
                                      std::stod(row_[5]));
    EXPECT_NEAR(found.sample.level_from_gimbal.norm(), 1.0, 1e-12);
    EXPECT_LT(found.sample.level_from_gimbal.angularDistance(expected.normalized()), 1e-7);
    EXPECT_EQ(found.sample.yaw == GimbalYaw::kFromNorth ? "north" : "nose", row_[6]);
    ASSERT_EQ(found.sample.holds_direction.has_value(), !row_[7].empty());
    EXPECT_EQ(found.sample.holds_direction.value_or(false), row_[7] == "1");
    EXPECT_EQ(found.device_id, std::stoi(row_[8]));
    EXPECT_EQ(found.failure_flags, std::stoul(row_[9]));
  }

  void operator()(const GnssStatus& found) const {
    ASSERT_EQ(row_[0], "GPS_RAW_INT");
    EXPECT_EQ(found.fix_type, std::stoi(row_[1]));
    ASSERT_EQ(found.sigma_horizontal_m.has_value(), !row_[2].empty());
    if (!row_[2].empty()) {
      EXPECT_DOUBLE_EQ(*found.sigma_horizontal_m * 1e3, std::stod(row_[2]));
    }
  }

  void operator()(const EstimatorStatus& found) const {
    EXPECT_TRUE(row_[0] == "EKF_STATUS_REPORT" || row_[0] == "ESTIMATOR_STATUS") << row_[0];
    EXPECT_EQ(found.flags, std::stoi(row_[1]));
  }

  void operator()(const Timesync& found) const {
    ASSERT_EQ(row_[0], "TIMESYNC");
    EXPECT_EQ(found.vehicle_ns, std::stoll(row_[1]));
    EXPECT_EQ(found.requester_ns, std::stoll(row_[2]));
    EXPECT_EQ(found.target.system, std::stoi(row_[3]));
    EXPECT_EQ(found.target.component, std::stoi(row_[4]));
  }

  void operator()(const SystemTime& found) const {
    ASSERT_EQ(row_[0], "SYSTEM_TIME");
    EXPECT_EQ(found.time, boot_time(row_[1]));
  }

  void operator()(const CommandAck& found) const {
    ASSERT_EQ(row_[0], "COMMAND_ACK");
    EXPECT_EQ(found.command, std::stoi(row_[1]));
    EXPECT_EQ(found.result, std::stoi(row_[2]));
    EXPECT_EQ(found.target.system, std::stoi(row_[3]));
    EXPECT_EQ(found.target.component, std::stoi(row_[4]));
  }

 private:
  const Row& row_;
};

class DecodedLog : public ::testing::TestWithParam<const char*> {};

TEST_P(DecodedLog, ReadsAsPymavlinkReadsIt) {
  const Tlog log = read_tlog(testing::fixture(std::string(GetParam()) + ".tlog"));
  const auto expected = testing::read_csv(testing::fixture(std::string(GetParam()) + ".expected.csv"));
  ASSERT_EQ(log.records().size(), expected.size());
  ASSERT_EQ(log.skipped_bytes(), 0U);
  FrameParser parser;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    SCOPED_TRACE("record " + std::to_string(i) + ": " + expected[i][0]);
    const TlogRecord& record = log.records()[i];
    ASSERT_EQ(parser.append(record.frame, record.size), record.size);
    const auto frame = parser.next();
    ASSERT_TRUE(frame);
    ASSERT_EQ(frame->size, record.size);
    std::visit(Comparison(expected[i]), decode(*frame));
    EXPECT_FALSE(parser.next());
  }
  EXPECT_EQ(parser.counts().bad_frames, 0U);
  EXPECT_EQ(parser.counts().junk_bytes, 0U);
}

INSTANTIATE_TEST_SUITE_P(Messages, DecodedLog, ::testing::Values("flight_v2", "link_v1", "wire"),
                         [](const auto& log) { return std::string(log.param); });

TEST(Messages, QuaternionAndEulerAnglesOfOneInstantAgree) {
  // The autopilot sends the same attitude in both forms: a check of axes and signs that does not rely on
  // another decoder.
  const Tlog log = read_tlog(testing::fixture("flight_v2.tlog"));
  FrameParser parser;
  std::optional<AttitudeSample> euler;
  int compared = 0;
  for (const TlogRecord& record : log.records()) {
    parser.append(record.frame, record.size);
    const Message message = decode(*parser.next());
    const auto* const attitude = std::get_if<AttitudeMessage>(&message);
    if (attitude == nullptr) continue;
    if (!attitude->from_quaternion) euler = attitude->sample;
    if (!attitude->from_quaternion || !euler || euler->time != attitude->sample.time) continue;
    EXPECT_NEAR(wrap_to_pi(attitude->sample.angles.roll_rad - euler->angles.roll_rad), 0.0, 1e-5);
    EXPECT_NEAR(wrap_to_pi(attitude->sample.angles.pitch_rad - euler->angles.pitch_rad), 0.0, 1e-5);
    EXPECT_NEAR(wrap_to_pi(attitude->sample.angles.yaw_rad - euler->angles.yaw_rad), 0.0, 1e-5);
    ++compared;
  }
  EXPECT_GT(compared, 20);
}

/// Rates and velocities against differences of what they are the rates of: axes, signs and units.
TEST(Messages, TellRatesThatAgreeWithWhatChanges) {
  const Tlog log = read_tlog(source_tree() / "data/flights/stock_path1.tlog");
  FrameParser parser;
  std::optional<AttitudeSample> attitude;
  std::optional<PositionSample> position;
  double turned = 0.0, turned_otherwise = 0.0, moved_m = 0.0, moved_otherwise_m = 0.0;
  for (const TlogRecord& record : log.records()) {
    parser.append(record.frame, record.size);
    const Message message = decode(*parser.next());
    if (const auto* const now = std::get_if<AttitudeMessage>(&message)) {
      const double pause_s = attitude ? seconds(now->sample.time - attitude->time) : 0.0;
      if (pause_s > 0.0) {
        const Eigen::AngleAxisd turn(ned_from_body(attitude->angles).conjugate() *
                                     ned_from_body(now->sample.angles));
        const Eigen::Vector3d told =
            0.5 * pause_s * (*attitude->rates_in_body_radps + *now->sample.rates_in_body_radps);
        turned += std::abs(turn.angle());
        turned_otherwise += (turn.angle() * turn.axis() - told).norm();
      }
      attitude = now->sample;
    }
    if (const auto* const now = std::get_if<PositionSample>(&message)) {
      const double pause_s = position ? seconds(now->time - position->time) : 0.0;
      if (pause_s > 0.0) {
        const Eigen::Vector2d way = LocalFrame(position->position).to_local(now->position).position_in_enu;
        const Eigen::Vector3d moved(way.x(), way.y(),
                                    now->height_above_home_m - position->height_above_home_m);
        moved_m += moved.norm();
        moved_otherwise_m +=
            (moved - 0.5 * pause_s * (*position->velocity_in_enu + *now->velocity_in_enu)).norm();
      }
      position = *now;
    }
  }
  EXPECT_LT(turned_otherwise, 0.4 * turned);
  EXPECT_LT(moved_otherwise_m, 0.2 * moved_m);
}

}  // namespace
}  // namespace geoloc::io
