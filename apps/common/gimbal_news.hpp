// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geoloc/pipeline/geolocator.hpp"

namespace geoloc::apps {

/// What a user is told of a gimbal that tells something else than it does: a line at the first of each kind.
class GimbalNews {
 public:
  /// After each sample of it. failure_flags: GIMBAL_DEVICE_ERROR_FLAGS. Lines are added to `lines`.
  void note(const Geolocator& geolocator, std::uint32_t failure_flags, std::vector<std::string>& lines);

 private:
  bool is_yaw_told_wrong_ = false;
  bool is_set_point_ = false;
  std::uint32_t told_failures_ = 0;
};

/// What was noticed of the gimbal in a run, for its end; empty where nothing was.
std::string remark_on_gimbal(const Geolocator& geolocator);

}  // namespace geoloc::apps
