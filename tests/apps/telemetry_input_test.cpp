// SPDX-License-Identifier: Apache-2.0
#include "app/telemetry_input.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace geoloc::apps {
namespace {

/// A video whose frames come when they are told to, with or without telemetry.
class ToldSource final : public io::VideoSource {
 public:
  explicit ToldSource(const io::HostClock& clock) : clock_(clock) {}

  void give_frame(bool has_telemetry) {
    ++status_.frames;
    if (!has_telemetry) return;
    ++status_.with_telemetry;
    io::FrameTelemetry telemetry{clock_.now(), {}};
    telemetry.record.vehicle = {{}, Duration{}};
    telemetry.record.gimbal = {{}, Duration{}};
    telemetry.record.position = {{-22.9, -43.1}, 30.0, 20.0, Duration{}};
    waiting_.push_back(telemetry);
  }
  void end() { status_.state = io::VideoState::kEnded; }

  std::optional<io::VideoFrame> next(Duration) override { return std::nullopt; }
  std::vector<io::FrameTelemetry> take_telemetry() override { return std::exchange(waiting_, {}); }
  io::VideoStatus status() const override { return status_; }

 private:
  const io::HostClock& clock_;
  io::VideoStatus status_;
  std::vector<io::FrameTelemetry> waiting_;
};

class TelemetryInputTest : public ::testing::Test {
 protected:
  TelemetryInput input(bool is_mavlink_asked_for) {
    return {{is_mavlink_asked_for, 1, false}, &socket_, guard_, video_, clock_};
  }

  /// Everything that was said, as one text.
  static std::string said(TelemetryInput& input) {
    std::string text;
    for (const std::string& message : input.take_messages()) text += message + "\n";
    return text;
  }

  io::HostClock clock_;
  io::UdpSocket socket_{io::parse_udp_endpoint("127.0.0.1:0")};
  io::LinkGuard guard_{io::MavlinkConfig{}, std::nullopt};
  ToldSource video_{clock_};
  Session session_{EstimationConfig{}};
};

TEST_F(TelemetryInputTest, VideoThatCarriesTelemetryIsTheVehicle) {
  TelemetryInput input = this->input(false);
  input.receive(session_);
  EXPECT_EQ(input.way(), TelemetryWay::kUndecided);
  EXPECT_FALSE(input.can_send());
  video_.give_frame(true);
  input.receive(session_);
  EXPECT_EQ(input.way(), TelemetryWay::kVideo);
  EXPECT_FALSE(input.can_send());
  EXPECT_TRUE(session_.link().status(clock_.now()).vehicle);
  const std::string text = said(input);
  EXPECT_NE(text.find("the video carries telemetry, which is used"), std::string::npos) << text;
  EXPECT_NE(text.find("camera.mount.kind"), std::string::npos) << text;
}

TEST_F(TelemetryInputTest, VideoWithoutTelemetryLeavesMavlink) {
  TelemetryInput input = this->input(false);
  for (int i = 0; i < 9; ++i) video_.give_frame(false);
  input.receive(session_);
  EXPECT_EQ(input.way(), TelemetryWay::kUndecided);
  video_.give_frame(false);
  input.receive(session_);
  EXPECT_EQ(input.way(), TelemetryWay::kMavlink);
  EXPECT_TRUE(input.can_send());
  EXPECT_EQ(said(input),
            "no telemetry in the video: MAVLink is listened to (--udp [HOST:]PORT says where)\n");
}

TEST_F(TelemetryInputTest, ShortVideosDecide) {
  TelemetryInput input = this->input(false);
  video_.give_frame(false);
  video_.end();
  input.receive(session_);
  EXPECT_EQ(input.way(), TelemetryWay::kMavlink);
}

TEST_F(TelemetryInputTest, MavlinkThatWasAskedForIsNeverMixedWithTheVideos) {
  TelemetryInput input = this->input(true);
  for (int i = 0; i < 30; ++i) {
    video_.give_frame(true);
    input.receive(session_);
  }
  EXPECT_EQ(input.way(), TelemetryWay::kMavlink);
  EXPECT_FALSE(session_.link().status(clock_.now()).vehicle);
  EXPECT_EQ(said(input), "the video carries telemetry, too, which is not used: --udp asks for MAVLink's\n");
}

}  // namespace
}  // namespace geoloc::apps
