// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "geoloc/io/output/run_record.hpp"

namespace geoloc::io {

/// The run as a bag of ROS 2 in MCAP (docs/formats.md): vehicle, raw fixes and objects as places on Earth,
/// and trajectory and objects as points and markers east, north and up of the local frame's origin. Objects
/// are shown from when they were first seen, as they were known in the end. What is not finite is left out.
std::string run_to_rosbag(const RunRecord& run);

}  // namespace geoloc::io
