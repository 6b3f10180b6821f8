// SPDX-License-Identifier: Apache-2.0
#include "common/video_vehicle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

#include "common/link_message.hpp"
#include "common/session.hpp"
#include "geoloc/geometry/angles.hpp"
#include "geoloc/io/mavlink/frame_parser.hpp"
#include "geoloc/io/mavlink/messages.hpp"
#include "geoloc/projection/projector.hpp"

namespace geoloc::apps {
namespace {

using namespace std::chrono_literals;

constexpr HostTime kFilmed{std::chrono::seconds{1'795'300'000}};

/// A record of a vehicle that flies north, as it was so long before it was made.
io::VideoTelemetry record_at(HostTime made_at, Duration attitude_age, Duration position_age) {
  const auto north_m = [](HostTime at) { return 5.0 * seconds(at - kFilmed); };
  io::VideoTelemetry record;
  record.made_at = io::CameraTime{made_at.time_since_epoch()};
  record.vehicle = {{0.1, -0.2, 3.0}, attitude_age};
  record.position = {
      {-22.906 + north_m(made_at - position_age) / 110'750.0, -43.133}, 30.0, 20.0, position_age};
  record.velocity = {Eigen::Vector3d(0.0, 5.0, 0.0), position_age};
  record.gimbal = {{0.0, -1.5, 0.3}, attitude_age};
  return record;
}

struct ToldMessage {
  HostTime at;
  std::vector<std::uint8_t> bytes;
};

std::vector<ToldMessage> told_by(VideoVehicle& vehicle, HostTime made_at, const io::VideoTelemetry& record) {
  std::vector<ToldMessage> told;
  vehicle.tell(made_at, record, [&told](HostTime at, const std::uint8_t* frame, std::size_t size) {
    told.push_back({at, {frame, frame + size}});
  });
  return told;
}

/// Frames at 25 Hz of a vehicle that tells its state at 10 Hz, which the camera hears 7 ms later.
template <typename Take>
void film(VideoVehicle& vehicle, Duration duration, const Take& take) {
  for (HostTime made_at = kFilmed; made_at < kFilmed + duration; made_at += 40ms) {
    const Duration age = (made_at - kFilmed) % 100ms + 7ms;
    for (const ToldMessage& told : told_by(vehicle, made_at, record_at(made_at, age, age))) take(told);
  }
}

TEST(VideoVehicle, EachValueIsToldOnceWhenItWasSo) {
  VideoVehicle vehicle(1);
  std::map<std::uint32_t, std::vector<HostTime>> told;
  io::FrameParser parser;
  film(vehicle, 10s, [&](const ToldMessage& message) {
    parser.append(message.bytes.data(), message.bytes.size());
    while (const auto frame = parser.next()) told[frame->message_id].push_back(message.at);
  });
  constexpr std::uint32_t kHeartbeat = 0, kAttitude = 30, kPosition = 33, kMountOrientation = 265;
  EXPECT_EQ(told.size(), 4U);
  EXPECT_EQ(told[kHeartbeat].size(), 10U);
  EXPECT_EQ(parser.sequences().lost({1, 1}), 0U);
  for (const std::uint32_t id : {kAttitude, kPosition, kMountOrientation}) {
    ASSERT_EQ(told[id].size(), 100U) << id;
    for (std::size_t i = 1; i < told[id].size(); ++i) EXPECT_EQ(told[id][i] - told[id][i - 1], 100ms);
    EXPECT_EQ(told[id].front(), kFilmed - 7ms);
  }
}

TEST(VideoVehicle, SessionsTakeItForAVehicle) {
  EstimationConfig config;
  config.geolocator.camera.mount = CameraMount::on_gimbal();
  Session session(config);
  VideoVehicle vehicle(1);
  film(vehicle, 5s, [&](const ToldMessage& message) {
    session.add_telemetry(message.at, message.bytes.data(), message.bytes.size());
  });
  const HostTime now = kFilmed + 5s;
  const LinkMessage message =
      link_message(session.link().status(now), session.geolocator(), TelemetryWay::kVideo);
  EXPECT_TRUE(message.is_good);
  EXPECT_EQ(message.text, "telemetry comes in the video, and the angles of its gimbal (10/s)");
  EXPECT_TRUE(session.process({now - 500ms, {}, 0.02}));
  const FrameView& view = session.geolocator().view();
  EXPECT_NEAR(view.vehicle.velocity_in_enu.y(), 5.0, 0.1);
  EXPECT_NEAR(view.vehicle.enu_from_body.translation.z(), 20.0, 0.01);
  EXPECT_EQ(session.geolocator().state().counters().position_steps, 0U);
}

TEST(VideoVehicle, PositionsMayBeMuchOlderThanAttitudes) {
  Session session(EstimationConfig{});
  VideoVehicle vehicle(1);
  for (HostTime made_at = kFilmed; made_at < kFilmed + 20s; made_at += 33ms) {
    const Duration attitude_age = (made_at - kFilmed) % 20ms + 3ms;
    const Duration position_age = (made_at - kFilmed) % 200ms + 250ms;
    for (const ToldMessage& told : told_by(vehicle, made_at, record_at(made_at, attitude_age, position_age)))
      session.add_telemetry(told.at, told.bytes.data(), told.bytes.size());
    if (made_at < kFilmed + 2s) continue;
    EXPECT_TRUE(session.process({made_at - 500ms, {}, 0.02}));
  }
  const io::LinkStatus link = session.link().status(kFilmed + 20s);
  EXPECT_EQ(link.clock.steps, 0U);
  EXPECT_EQ(link.telemetry.suspect_stamps, 0U);
  EXPECT_NEAR(link.attitude_rate_hz, 30.0, 1.5);
  EXPECT_NEAR(link.position_rate_hz, 5.0, 1.0);  // the last ones are under way
  EXPECT_EQ(session.geolocator().state().counters().position_steps, 0U);
}

TEST(VideoVehicle, AttitudesAndAnglesPassUnchanged) {
  VideoVehicle vehicle(7);
  io::FrameParser parser;
  int checked = 0;
  for (const ToldMessage& message : told_by(vehicle, kFilmed, record_at(kFilmed, 30ms, 80ms))) {
    parser.append(message.bytes.data(), message.bytes.size());
    const auto frame = parser.next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->sender, (io::MavAddress{7, 1}));
    const io::Message content = io::decode(*frame);
    if (const auto* attitude = std::get_if<io::AttitudeMessage>(&content)) {
      EXPECT_NEAR(attitude->sample.angles.roll_rad, 0.1, 1e-6);
      EXPECT_NEAR(attitude->sample.angles.pitch_rad, -0.2, 1e-6);
      EXPECT_NEAR(attitude->sample.angles.yaw_rad, 3.0, 1e-6);
      EXPECT_EQ(message.at, kFilmed - 30ms);
      ++checked;
    }
    if (const auto* gimbal = std::get_if<io::GimbalMessage>(&content)) {
      EXPECT_LT(gimbal->sample.level_from_gimbal.angularDistance(ned_from_body({0.0, -1.5, 0.3})), 1e-6);
      EXPECT_EQ(gimbal->sample.yaw, GimbalYaw::kFromNose);
      EXPECT_FALSE(gimbal->sample.holds_direction);
      ++checked;
    }
  }
  EXPECT_EQ(checked, 2);
}

TEST(VideoVehicle, FramesAreLocatedWithTheFieldOfViewThatTheyTell) {
  Session session(EstimationConfig{});
  const CameraIntrinsics& image = session.geolocator().projector().camera().intrinsics();
  const double half_width = 0.5 * image.width_px / image.fx_px;
  VideoVehicle vehicle(1);
  for (HostTime made_at = kFilmed; made_at < kFilmed + 10s; made_at += 40ms) {
    io::VideoTelemetry record = record_at(made_at, 10ms, 20ms);
    const double zoom = made_at < kFilmed + 5s ? 1.0 : 2.0;
    record.horizontal_fov_deg = 2.0 * std::atan(half_width / zoom) * kDegPerRad;
    for (const ToldMessage& told : told_by(vehicle, made_at, record))
      session.add_telemetry(told.at, told.bytes.data(), told.bytes.size());
  }
  EXPECT_TRUE(session.process({kFilmed + 9s, {}, 0.02}));
  const Geolocator& geolocator = session.geolocator();
  EXPECT_NEAR(geolocator.projector().focal_px(geolocator.view()).x(), 2.0 * image.fx_px, 0.001 * image.fx_px);
}

TEST(VideoVehicle, VelocitiesThatAreNotToldAreThoseBetweenPositions) {
  VideoVehicle vehicle(1);
  io::FrameParser parser;
  double north_mps = 0.0;
  for (int i = 0; i < 10; ++i) {
    io::VideoTelemetry record = record_at(kFilmed + i * 200ms, 10ms, 20ms);
    record.velocity.reset();
    for (const ToldMessage& message : told_by(vehicle, kFilmed + i * 200ms, record)) {
      parser.append(message.bytes.data(), message.bytes.size());
      const auto frame = parser.next();
      ASSERT_TRUE(frame);
      const io::Message content = io::decode(*frame);
      if (const auto* position = std::get_if<PositionSample>(&content))
        north_mps = position->velocity_in_enu->y();
    }
  }
  EXPECT_NEAR(north_mps, 5.0, 0.1);
}

TEST(VideoVehicle, OldValuesAndUnknownOnesAreNotTold) {
  VideoVehicle vehicle(1);
  io::VideoTelemetry record = record_at(kFilmed, 1001ms, 9s);
  EXPECT_EQ(told_by(vehicle, kFilmed, record).size(), 1U);  // the heartbeat
  EXPECT_EQ(told_by(vehicle, kFilmed + 40ms, io::VideoTelemetry{}).size(), 0U);
}

TEST(VideoVehicle, ACameraWhoseClockIsSetBackIsHeardOn) {
  VideoVehicle vehicle(1);
  told_by(vehicle, kFilmed, record_at(kFilmed, 10ms, 10ms));
  const HostTime earlier = kFilmed - 5s;
  EXPECT_EQ(told_by(vehicle, earlier, record_at(earlier, 10ms, 10ms)).size(), 4U);
}

}  // namespace
}  // namespace geoloc::apps
