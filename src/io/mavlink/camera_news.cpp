// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/camera_news.hpp"

#include <all/mavlink.h>

#include <chrono>

#include "geoloc/io/mavlink/messages.hpp"
#include "unpack.hpp"

namespace geoloc::io {
namespace {

std::optional<CameraNews> recorded_video(const Frame& frame) {
  constexpr std::uint8_t kRuns = 1;
  constexpr std::uint32_t kLongest_ms = 24 * 3600 * 1000;
  const auto fields = unpack(frame, mavlink_msg_camera_capture_status_decode);
  if (fields.video_status != kRuns || fields.recording_time_ms > kLongest_ms) return std::nullopt;
  return CameraNews{CameraNewsKind::kVideoRecorded, 0, std::chrono::milliseconds{fields.recording_time_ms}};
}

std::optional<CameraNews> wanted_video(const Frame& frame) {
  const auto command = decode_command(frame);
  if (!command || command->command != MAV_CMD_VIDEO_START_CAPTURE) return std::nullopt;
  return CameraNews{CameraNewsKind::kVideoWanted};
}

}  // namespace

std::optional<CameraNews> decode_camera_news(const Frame& frame) {
  switch (frame.message_id) {
    case MAVLINK_MSG_ID_CAMERA_TRIGGER:
      return CameraNews{
          CameraNewsKind::kTriggered,
          static_cast<std::int32_t>(unpack(frame, mavlink_msg_camera_trigger_decode).seq & 0x7FFFFFFFU)};
    case MAVLINK_MSG_ID_CAMERA_IMAGE_CAPTURED:
      return CameraNews{CameraNewsKind::kCaptured,
                        unpack(frame, mavlink_msg_camera_image_captured_decode).image_index};
    case MAVLINK_MSG_ID_CAMERA_FEEDBACK:
      return CameraNews{CameraNewsKind::kFedBack, unpack(frame, mavlink_msg_camera_feedback_decode).img_idx};
    case MAVLINK_MSG_ID_COMMAND_LONG:
      return wanted_video(frame);
    case MAVLINK_MSG_ID_CAMERA_CAPTURE_STATUS:
      return recorded_video(frame);
    default:
      return std::nullopt;
  }
}

}  // namespace geoloc::io
