// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/camera_component.hpp"

#include <all/mavlink.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "io/mavlink/test_frames.hpp"

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;
using testing::FrameFactory;

constexpr HostTime kBegin{std::chrono::seconds{1'795'300'000}};
constexpr MavAddress kVehicle{1, 1};
constexpr MavAddress kCamera{1, 105};

/// A camera on a link, and what it sent, decoded by the generated headers.
class CameraComponentTest : public ::testing::Test {
 protected:
  void SetUp() override { poll(0s); }

  std::vector<mavlink_message_t> poll(Duration after_start, bool is_v2 = true) {
    std::vector<mavlink_message_t> said;
    camera_.poll(kBegin + after_start, kVehicle, is_v2, [&](const std::uint8_t* frame, std::size_t size) {
      mavlink_message_t message{};
      mavlink_status_t status{};
      mavlink_message_t buffer{};
      mavlink_status_t buffer_status{};
      for (std::size_t i = 0; i < size; ++i)
        mavlink_frame_char_buffer(&buffer, &buffer_status, frame[i], &message, &status);
      said.push_back(message);
    });
    return said;
  }

  void command(std::uint16_t command, float parameter1, float parameter2 = 0.0F, MavAddress to = kCamera) {
    const auto frame = station_.command_long(command, to, parameter1, parameter2);
    camera_.consume(frame.data(), frame.size());
  }

  /// The answer to a command.
  int result_of(std::uint16_t number, float parameter1, float parameter2 = 0.0F) {
    command(number, parameter1, parameter2);
    for (const mavlink_message_t& message : poll(0s)) {
      if (message.msgid == MAVLINK_MSG_ID_COMMAND_ACK) return mavlink_msg_command_ack_get_result(&message);
    }
    return -1;
  }

  void see(std::vector<CameraTarget> targets, Duration after_start = 0s) {
    CameraView view;
    view.captured_at = kBegin + after_start;
    view.targets = std::move(targets);
    camera_.update(view);
  }

  static int count(const std::vector<mavlink_message_t>& said, std::uint32_t id) {
    return static_cast<int>(
        std::count_if(said.begin(), said.end(), [&](const auto& message) { return message.msgid == id; }));
  }

  /// Latitude of the tracked object.
  double tracked_latitude_deg(Duration after_start) {
    for (const mavlink_message_t& message : poll(after_start)) {
      if (message.msgid != MAVLINK_MSG_ID_CAMERA_TRACKING_GEO_STATUS) continue;
      mavlink_camera_tracking_geo_status_t status;
      mavlink_msg_camera_tracking_geo_status_decode(&message, &status);
      return status.lat / 1e7;
    }
    return std::nan("");
  }

  CameraComponent camera_{105, CameraIntrinsics{}};
  FrameFactory station_{{255, 190}};
};

CameraTarget target(std::uint64_t id, double distance_m, std::optional<Eigen::Vector2d> image_point = {}) {
  return {id, {static_cast<double>(id), 8.0}, 0.5, {}, {}, distance_m, image_point};
}

TEST_F(CameraComponentTest, SaysThatItIsThereOnceASecond) {
  EXPECT_EQ(count(poll(500ms), MAVLINK_MSG_ID_HEARTBEAT), 0);
  const auto said = poll(1s);
  ASSERT_EQ(count(said, MAVLINK_MSG_ID_HEARTBEAT), 1);
  EXPECT_EQ(mavlink_msg_heartbeat_get_type(&said.front()), MAV_TYPE_CAMERA);
  EXPECT_EQ(said.front().sysid, 1);
  EXPECT_EQ(said.front().compid, 105);
}

TEST_F(CameraComponentTest, IsSilentOnALinkThatCannotCarryIt) {
  EXPECT_TRUE(poll(10s, false).empty());
}

TEST_F(CameraComponentTest, TracksTheNearestUnlessAPointOfTheImageWasSelected) {
  see({target(1, 30.0, Eigen::Vector2d(0.2, 0.2)), target(2, 20.0, Eigen::Vector2d(0.8, 0.8)),
       target(3, 25.0)});
  EXPECT_EQ(tracked_latitude_deg(1s), 2.0);
  EXPECT_EQ(result_of(MAV_CMD_CAMERA_TRACK_POINT, 0.21F, 0.18F), MAV_RESULT_ACCEPTED);
  EXPECT_EQ(tracked_latitude_deg(2s), 1.0);
  EXPECT_EQ(result_of(MAV_CMD_CAMERA_TRACK_POINT, 0.5F, 0.5F), MAV_RESULT_DENIED) << "nothing is there";
  EXPECT_EQ(tracked_latitude_deg(3s), 1.0);
  see({target(2, 20.0), target(3, 25.0)}, 3s);
  EXPECT_EQ(tracked_latitude_deg(4s), 2.0) << "the selected one is gone";
  see({target(1, 30.0), target(2, 20.0)}, 4s);
  EXPECT_EQ(result_of(MAV_CMD_CAMERA_STOP_TRACKING, 0.0F), MAV_RESULT_ACCEPTED);
  EXPECT_EQ(tracked_latitude_deg(5s), 2.0);
}

TEST_F(CameraComponentTest, WithoutAnObjectItTellsNothingUnasked) {
  see({});
  EXPECT_EQ(count(poll(1s), MAVLINK_MSG_ID_CAMERA_TRACKING_GEO_STATUS), 0);
  command(MAV_CMD_REQUEST_MESSAGE, 276.0F);
  const auto said = poll(1s);
  ASSERT_EQ(count(said, MAVLINK_MSG_ID_CAMERA_TRACKING_GEO_STATUS), 1);
  EXPECT_EQ(mavlink_msg_camera_tracking_geo_status_get_tracking_status(&said.back()),
            CAMERA_TRACKING_STATUS_FLAGS_IDLE);
}

TEST_F(CameraComponentTest, AViewThatIsOldIsNotRepeated) {
  see({target(1, 20.0)});
  EXPECT_EQ(tracked_latitude_deg(2s), 1.0);
  EXPECT_TRUE(std::isnan(tracked_latitude_deg(10s)));
}

TEST_F(CameraComponentTest, NoIntervalFloodsTheLink) {
  see({target(1, 20.0)});
  EXPECT_EQ(result_of(MAV_CMD_SET_MESSAGE_INTERVAL, 276.0F, 1.0F), MAV_RESULT_ACCEPTED);
  int sent = 0;
  for (auto after = 0ms; after < 1000ms; after += 1ms)
    sent += count(poll(after), MAVLINK_MSG_ID_CAMERA_TRACKING_GEO_STATUS);
  EXPECT_LE(sent, 11);
  EXPECT_EQ(result_of(MAV_CMD_SET_MESSAGE_INTERVAL, 276.0F, -1.0F), MAV_RESULT_ACCEPTED);
  EXPECT_EQ(count(poll(2s), MAVLINK_MSG_ID_CAMERA_TRACKING_GEO_STATUS), 0);
}

TEST_F(CameraComponentTest, AFloodOfCommandsIsNotAnswered) {
  for (int i = 0; i < 10'000; ++i) command(MAV_CMD_REQUEST_MESSAGE, 259.0F);
  EXPECT_LE(poll(0s).size(), 2U * 16U);
}

TEST_F(CameraComponentTest, AnswersHaveABudgetPerSecondHoweverManyAsk) {
  std::size_t bytes = 0;
  int acknowledged = 0, of_the_other = 0;
  FrameFactory other({254, 190});
  for (auto after = 0ms; after < 10s; after += 10ms) {
    for (int i = 0; i < 30; ++i) command(MAV_CMD_REQUEST_MESSAGE, 259.0F);
    if (after % 1s == 0s) {
      const auto frame = other.command_long(MAV_CMD_REQUEST_MESSAGE, kCamera, 259.0F, 0.0F);
      camera_.consume(frame.data(), frame.size());
    }
    for (const mavlink_message_t& message : poll(after)) {
      bytes += message.len + 12U;
      if (message.msgid != MAVLINK_MSG_ID_COMMAND_ACK) continue;
      ++acknowledged;
      of_the_other += mavlink_msg_command_ack_get_target_system(&message) == 254 ? 1 : 0;
    }
  }
  EXPECT_LE(acknowledged, 16 + 100) << "of 30 000";
  EXPECT_GE(acknowledged, 100);
  EXPECT_EQ(of_the_other, 10) << "a flood of one sender leaves room for others";
  EXPECT_LT(bytes / 10, 4000U) << "a second";
}

TEST_F(CameraComponentTest, ObeysNothingThatIsNotForIt) {
  command(MAV_CMD_CAMERA_STOP_TRACKING, 0.0F, 0.0F, {1, 100});
  command(MAV_CMD_REQUEST_MESSAGE, 259.0F, 0.0F, {2, 105});
  command(MAV_CMD_DO_SET_MODE, 1.0F, 0.0F, {1, 0});
  EXPECT_TRUE(poll(0s).empty());
  command(MAV_CMD_REQUEST_MESSAGE, 259.0F, 0.0F, {1, 0});  // "every camera, say what you are"
  EXPECT_EQ(count(poll(0s), MAVLINK_MSG_ID_CAMERA_INFORMATION), 1);
}

TEST_F(CameraComponentTest, NonsenseIsRefused) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  see({target(1, 20.0, Eigen::Vector2d(0.5, 0.5))});
  for (const float value : {nan, infinite, -1.0F, 1e30F}) {
    EXPECT_EQ(result_of(MAV_CMD_REQUEST_MESSAGE, value), MAV_RESULT_UNSUPPORTED);
    EXPECT_EQ(result_of(MAV_CMD_SET_MESSAGE_INTERVAL, value), MAV_RESULT_UNSUPPORTED);
    EXPECT_EQ(result_of(MAV_CMD_CAMERA_TRACK_POINT, value, 0.5F), MAV_RESULT_DENIED);
  }
  EXPECT_EQ(result_of(MAV_CMD_SET_MESSAGE_INTERVAL, 276.0F, nan), MAV_RESULT_DENIED);
  EXPECT_EQ(result_of(MAV_CMD_SET_MESSAGE_INTERVAL, 271.0F, 3e38F), MAV_RESULT_ACCEPTED);
  EXPECT_EQ(result_of(MAV_CMD_IMAGE_START_CAPTURE, 0.0F), MAV_RESULT_UNSUPPORTED);
}

TEST_F(CameraComponentTest, AnImageCentreAboveTheHorizonIsAtInfinity) {
  see({});
  command(MAV_CMD_REQUEST_MESSAGE, 271.0F);
  const auto said = poll(0s);
  ASSERT_EQ(count(said, MAVLINK_MSG_ID_CAMERA_FOV_STATUS), 1);
  mavlink_camera_fov_status_t view;
  mavlink_msg_camera_fov_status_decode(&said.back(), &view);
  EXPECT_EQ(view.lat_image, std::numeric_limits<std::int32_t>::min());
  EXPECT_NEAR(view.hfov, 70.0, 0.01);
}

TEST_F(CameraComponentTest, ACameraThatHasZoomedTellsWhatItSees) {
  CameraView zoomed;
  zoomed.captured_at = kBegin;
  zoomed.focal_px = Eigen::Vector2d(640.0, 360.0);  // of an image of 1280 x 720
  camera_.update(zoomed);
  command(MAV_CMD_REQUEST_MESSAGE, 271.0F);
  const auto said = poll(0s);
  ASSERT_EQ(count(said, MAVLINK_MSG_ID_CAMERA_FOV_STATUS), 1);
  mavlink_camera_fov_status_t view;
  mavlink_msg_camera_fov_status_decode(&said.back(), &view);
  EXPECT_NEAR(view.hfov, 90.0, 0.01);
  EXPECT_NEAR(view.vfov, 90.0, 0.01);
}

}  // namespace
}  // namespace geoloc::io
