// SPDX-License-Identifier: Apache-2.0
#include "geoloc/state/gimbal_yaw_watch.hpp"

#include <chrono>
#include <cmath>

#include "geoloc/geometry/angles.hpp"

namespace geoloc {
namespace {

constexpr Duration kLongestPause = std::chrono::seconds{1};
constexpr Duration kSecond = std::chrono::seconds{1};
/// A vehicle that circles is judged so often.
constexpr Duration kLongestTurn = std::chrono::seconds{15};
/// In a second: less is no turn, and a gimbal that lags behind has caught up.
constexpr double kStraight_rad = 3.0 * kRadPerDeg;
constexpr double kLeastTurn_rad = 30.0 * kRadPerDeg;
/// Turns that differ by this share of their size are the same.
constexpr double kSameShare = 0.25;
/// A camera that looks ahead within so much is not held in a direction by chance.
constexpr double kAhead_rad = 10.0 * kRadPerDeg;
/// So far must the vehicle have turned, and by so many times more against than for what is believed.
constexpr double kProof_rad = 60.0 * kRadPerDeg, kDominance = 3.0;
constexpr double kMemory_rad = 4.0 * kPi;

/// From the axis to the right, which is level in a stabilised camera: it also tells of one that looks down.
double yaw_rad(const Eigen::Quaterniond& level_from_gimbal) {
  const Eigen::Vector3d right = level_from_gimbal * Eigen::Vector3d::UnitY();
  return std::atan2(-right.x(), right.y());
}

/// What the yaw of a gimbal counts from that turned by so much while the vehicle did; nullopt: nobody knows.
std::optional<GimbalYaw> origin_of(const GimbalSample& gimbal, double gimbal_turn_rad,
                                   double vehicle_turn_rad) {
  const double same_rad = kSameShare * std::abs(vehicle_turn_rad);
  if (std::abs(gimbal_turn_rad - vehicle_turn_rad) < same_rad) return GimbalYaw::kFromNorth;
  if (std::abs(gimbal_turn_rad + vehicle_turn_rad) < same_rad) return GimbalYaw::kFromNose;
  if (std::abs(gimbal_turn_rad) >= same_rad || !gimbal.holds_direction) return std::nullopt;
  const bool looks_ahead = std::abs(yaw_rad(gimbal.level_from_gimbal)) < kAhead_rad;
  if (gimbal.yaw == GimbalYaw::kFromNose && looks_ahead) return GimbalYaw::kFromNose;
  return *gimbal.holds_direction ? GimbalYaw::kFromNorth : GimbalYaw::kFromNose;
}

}  // namespace

void GimbalYawWatch::observe(const GimbalSample& gimbal, double vehicle_yaw_rad) {
  const Yaws now{gimbal.time, vehicle_yaw_rad, yaw_rad(gimbal.level_from_gimbal)};
  if (!last_ || now.time - last_->time > kLongestPause) return begin(now);
  if (now.time <= last_->time) return;
  for (Turn* const turn : {&turn_, &second_}) {
    turn->vehicle_rad += wrap_to_pi(now.vehicle_rad - last_->vehicle_rad);
    turn->gimbal_rad += wrap_to_pi(now.gimbal_rad - last_->gimbal_rad);
  }
  last_ = now;
  if (now.time - second_.begin < kSecond) return;
  const bool goes_straight = std::abs(second_.vehicle_rad) < kStraight_rad;
  second_ = {now.time};
  if (!goes_straight && now.time - turn_.begin < kLongestTurn) return;
  if (std::abs(turn_.vehicle_rad) >= kLeastTurn_rad) judge(gimbal);
  turn_ = {now.time};
}

void GimbalYawWatch::begin(const Yaws& now) {
  last_ = now;
  turn_ = second_ = {now.time};
}

void GimbalYawWatch::judge(const GimbalSample& gimbal) {
  const auto origin = origin_of(gimbal, turn_.gimbal_rad, turn_.vehicle_rad);
  if (origin) vote(*origin == gimbal.yaw, std::abs(turn_.vehicle_rad));
}

void GimbalYawWatch::vote(bool agrees, double turned_rad) {
  (agrees ? agreeing_rad_ : contradicting_rad_) += turned_rad;
  const double against = is_told_wrong_ ? agreeing_rad_ : contradicting_rad_;
  const double for_it = is_told_wrong_ ? contradicting_rad_ : agreeing_rad_;
  if (against >= kProof_rad && against > kDominance * for_it) is_told_wrong_ = !is_told_wrong_;
  if (agreeing_rad_ + contradicting_rad_ < kMemory_rad) return;
  agreeing_rad_ *= 0.5;
  contradicting_rad_ *= 0.5;
}

}  // namespace geoloc
