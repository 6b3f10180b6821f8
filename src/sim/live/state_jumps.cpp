// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/live/state_jumps.hpp"

#include <all/mavlink.h>

#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/attitude.hpp"
#include "sim/live/log_builder.hpp"

namespace geoloc::sim {
namespace {

constexpr double kGlitch_s = 5.0;

struct NamedJump {
  const char* name;
  StateJump jump;
  bool is_glitch;  ///< it goes back
};

std::array<NamedJump, 5> named_jumps() {
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  return {{{"glitch", {{40.0, -30.0, 0.0}, 0.0, 0.0, {}}, true},
           {"reset", {{-1.8, 2.4, 0.0}, 0.0, 0.0, {}}, false},
           {"height", {{0.0, 0.0, 10.0}, 0.0, 0.0, {}}, false},
           {"yaw", {none, 20.0, 0.0, {}}, false},
           {"home", {none, 0.0, -3.0, {}}, false}}};
}

std::int32_t scaled(double value, double scale) {
  return static_cast<std::int32_t>(std::lround(value * scale));
}

std::optional<Payload> jumped(const FrameView& frame, const StateJump& jump) {
  switch (frame.message_id) {
    case MAVLINK_MSG_ID_GLOBAL_POSITION_INT: {
      constexpr double kUnitsPerDegree = 1e7, kMetresPerDegree = 111.32e3, kUnitsPerMetre = 1e3;
      auto fields = fields_in<mavlink_global_position_int_t>(frame);
      const double east_scale = std::cos(fields.lat / kUnitsPerDegree * kRadPerDeg);
      const Eigen::Vector3d& by = jump.position_in_enu;
      fields.lat += scaled(by.y() / kMetresPerDegree, kUnitsPerDegree);
      fields.lon += scaled(by.x() / (kMetresPerDegree * east_scale), kUnitsPerDegree);
      fields.alt += scaled(by.z(), kUnitsPerMetre);
      fields.relative_alt += scaled(by.z() - jump.home_up_m, kUnitsPerMetre);
      return payload_with(fields);
    }
    case MAVLINK_MSG_ID_LOCAL_POSITION_NED: {
      auto fields = fields_in<mavlink_local_position_ned_t>(frame);
      fields.x += static_cast<float>(jump.position_in_enu.y());
      fields.y += static_cast<float>(jump.position_in_enu.x());
      fields.z -= static_cast<float>(jump.position_in_enu.z());
      return payload_with(fields);
    }
    case MAVLINK_MSG_ID_ATTITUDE: {
      auto fields = fields_in<mavlink_attitude_t>(frame);
      fields.yaw = static_cast<float>(wrap_to_pi(fields.yaw + jump.yaw_deg * kRadPerDeg));
      return payload_with(fields);
    }
    case MAVLINK_MSG_ID_ATTITUDE_QUATERNION: {
      auto fields = fields_in<mavlink_attitude_quaternion_t>(frame);
      const Eigen::Quaterniond turned =
          Eigen::AngleAxisd(jump.yaw_deg * kRadPerDeg, Eigen::Vector3d::UnitZ()) *
          Eigen::Quaterniond(fields.q1, fields.q2, fields.q3, fields.q4);
      fields.q1 = static_cast<float>(turned.w());
      fields.q2 = static_cast<float>(turned.x());
      fields.q3 = static_cast<float>(turned.y());
      fields.q4 = static_cast<float>(turned.z());
      return payload_with(fields);
    }
    default:
      return std::nullopt;
  }
}

}  // namespace

std::vector<std::string> state_jump_names() {
  std::vector<std::string> names;
  for (const NamedJump& named : named_jumps()) names.emplace_back(named.name);
  return names;
}

StateJump state_jump(const std::string& name, const Trajectory& truth) {
  std::string known;
  for (const NamedJump& named : named_jumps()) {
    known += std::string(" ") + named.name;
    if (name != named.name) continue;
    const TimeSpan survey = truth.survey();
    StateJump jump = named.jump;
    jump.when.begin = survey.begin + (survey.end - survey.begin) / 2;
    jump.when.end =
        named.is_glitch ? jump.when.begin + from_seconds(kGlitch_s) : truth.span().end + from_seconds(3600.0);
    return jump;
  }
  throw std::invalid_argument("no jump '" + name + "'; there are:" + known);
}

Flight with_jump(const Flight& flight, const StateJump& jump) {
  LogBuilder log;
  for (const io::TlogRecord& record : flight.telemetry.records()) {
    const auto frame = view_frame(record.frame, record.size);
    const VehicleTime now{record.received_at - flight.booted_at};
    const bool has_jumped = now >= jump.when.begin && now < jump.when.end;
    const auto payload = frame && has_jumped ? jumped(*frame, jump) : std::nullopt;
    if (payload) {
      log.add(record.received_at, *frame, *payload);
    } else {
      log.add(record);
    }
  }
  return {flight.name, log.build(), flight.truth, flight.booted_at};
}

}  // namespace geoloc::sim
