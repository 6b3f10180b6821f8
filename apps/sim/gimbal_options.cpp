// SPDX-License-Identifier: Apache-2.0
#include "sim/gimbal_options.hpp"

#include "sim/option_groups.hpp"

namespace geoloc::sim {

void add_gimbal_options(CLI::App& program, GimbalOptions& options, CLI::Option* mount_pitch) {
  CLI::Option* const gimbal =
      program
          .add_option("--gimbal", options.aim,
                      "The camera is on a gimbal that looks down (nadir), 45 deg down (45), or up and down "
                      "between (sweep) [fixed to the body]")
          ->check(CLI::IsMember({"nadir", "45", "sweep"}))
          ->excludes(mount_pitch)
          ->group(kCameraGroup);
  const auto add = [&](const char* name, std::string& value, std::vector<std::string> values,
                       const char* help) {
    program.add_option(name, value, help)
        ->check(CLI::IsMember(std::move(values)))
        ->capture_default_str()
        ->needs(gimbal)
        ->group(kCameraGroup);
  };
  add("--gimbal-yaw", options.yaw, {"follow", "lock"},
      "It follows the vehicle's nose, or holds a direction within its limits");
  add("--gimbal-told-yaw", options.told_yaw, {"nose", "north"}, "What the yaw that it tells counts from");
  add("--gimbal-message", options.message, {"285", "265", "158"},
      "GIMBAL_DEVICE_ATTITUDE_STATUS, MOUNT_ORIENTATION or MOUNT_STATUS, which has yaws from the nose alone");
  program
      .add_flag("--gimbal-perfect", options.is_perfect,
                "It measures its angles rightly, and shakes by a tenth only")
      ->needs(gimbal)
      ->group(kCameraGroup);
  const auto add_fault = [&](const char* name, bool& value, const char* help) {
    program.add_flag(name, value, help)->needs(gimbal)->group(kHiddenGroup);
  };
  add_fault("--gimbal-wrong-flag", options.has_wrong_flag,
            "The gimbal says that its yaw counts from the other than it does");
  add_fault("--gimbal-setpoint-feedback", options.tells_set_point,
            "The gimbal tells the angles that it was told to hold, not those that it measures");
}

std::optional<GimbalSettings> to_settings(const GimbalOptions& options) {
  if (options.aim.empty()) return std::nullopt;
  GimbalSettings settings;
  settings.aim = options.aim == "nadir" ? GimbalAim::kNadir
                 : options.aim == "45"  ? GimbalAim::kOblique
                                        : GimbalAim::kSweep;
  settings.holds_direction = options.yaw == "lock";
  settings.told_yaw = options.told_yaw == "north" ? GimbalYaw::kFromNorth : GimbalYaw::kFromNose;
  settings.telling = options.message == "285"   ? GimbalTelling::kDeviceStatus
                     : options.message == "265" ? GimbalTelling::kMountOrientation
                                                : GimbalTelling::kMountStatus;
  settings.has_wrong_flag = options.has_wrong_flag;
  settings.tells_set_point = options.tells_set_point;
  settings.is_perfect = options.is_perfect;
  const bool tells_no_frame = settings.telling == GimbalTelling::kMountStatus;
  if (tells_no_frame && (settings.told_yaw == GimbalYaw::kFromNorth || settings.has_wrong_flag))
    throw std::invalid_argument(
        "--gimbal-message 158 has yaws from the nose and no flags: leave out --gimbal-told-yaw north and "
        "--gimbal-wrong-flag, or choose 285 or 265");
  return settings;
}

}  // namespace geoloc::sim
