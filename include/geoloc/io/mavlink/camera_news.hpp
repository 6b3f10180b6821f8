// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "geoloc/geometry/time.hpp"
#include "geoloc/io/mavlink/frame.hpp"

namespace geoloc::io {

/// How a message tells of a camera's pictures or videos. One picture may be told by all three kinds, a later
/// one being nearer to the exposure.
enum class CameraNewsKind : std::uint8_t {
  kTriggered,     ///< CAMERA_TRIGGER
  kCaptured,      ///< CAMERA_IMAGE_CAPTURED
  kFedBack,       ///< CAMERA_FEEDBACK
  kVideoWanted,   ///< a command to begin a video (MAV_CMD_VIDEO_START_CAPTURE)
  kVideoRecorded  ///< CAMERA_CAPTURE_STATUS of a video that is being recorded
};

struct CameraNews {
  CameraNewsKind kind;
  std::int32_t picture = 0;  ///< its number, by which a repetition is known
  Duration ago{};            ///< since the video began, of kVideoRecorded
};

/// nullopt for any other message, and for times that cannot be.
std::optional<CameraNews> decode_camera_news(const Frame& frame);

}  // namespace geoloc::io
