// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/live/autopilot_manners.hpp"

#include <all/mavlink.h>

#include <utility>

namespace geoloc::sim {
namespace {

AutopilotManners px4_manners(std::vector<UnaskedStream> unasked) {
  AutopilotManners manners;
  manners.unasked = std::move(unasked);
  manners.begins_in_v1 = true;
  manners.knows_data_streams = false;
  manners.refusal = MAV_RESULT_FAILED;
  manners.heartbeat_type = MAV_AUTOPILOT_PX4;
  return manners;
}

}  // namespace

AutopilotManners ardupilot_manners() {
  AutopilotManners manners;
  manners.refusal = MAV_RESULT_DENIED;
  manners.heartbeat_type = MAV_AUTOPILOT_ARDUPILOTMEGA;
  return manners;
}

AutopilotManners px4_onboard_manners() {
  AutopilotManners manners = px4_manners({{MAVLINK_MSG_ID_ATTITUDE, 100.0},
                                          {MAVLINK_MSG_ID_ATTITUDE_QUATERNION, 50.0},
                                          {MAVLINK_MSG_ID_GLOBAL_POSITION_INT, 50.0},
                                          {MAVLINK_MSG_ID_LOCAL_POSITION_NED, 30.0},
                                          {MAVLINK_MSG_ID_GPS_RAW_INT, 10.0},
                                          {MAVLINK_MSG_ID_ESTIMATOR_STATUS, 1.0},
                                          {MAVLINK_MSG_ID_SYSTEM_TIME, 1.0},
                                          {MAVLINK_MSG_ID_GPS_GLOBAL_ORIGIN, 1.0},
                                          {MAVLINK_MSG_ID_GIMBAL_DEVICE_ATTITUDE_STATUS, 1.0},
                                          {MAVLINK_MSG_ID_MOUNT_ORIENTATION, 10.0},
                                          {MAVLINK_MSG_ID_HOME_POSITION, 0.5}});
  manners.timesync_rate_hz = 10.0;
  return manners;
}

AutopilotManners px4_ground_manners() {
  return px4_manners({{MAVLINK_MSG_ID_ATTITUDE, 15.0},
                      {MAVLINK_MSG_ID_ATTITUDE_QUATERNION, 10.0},
                      {MAVLINK_MSG_ID_GLOBAL_POSITION_INT, 5.0},
                      {MAVLINK_MSG_ID_LOCAL_POSITION_NED, 1.0},
                      {MAVLINK_MSG_ID_GPS_RAW_INT, 1.0},
                      {MAVLINK_MSG_ID_ESTIMATOR_STATUS, 0.5},
                      {MAVLINK_MSG_ID_GPS_GLOBAL_ORIGIN, 1.0},
                      {MAVLINK_MSG_ID_GIMBAL_DEVICE_ATTITUDE_STATUS, 1.0},
                      {MAVLINK_MSG_ID_HOME_POSITION, 0.5}});
}

}  // namespace geoloc::sim
