// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "geoloc/camera/camera.hpp"
#include "geoloc/camera/detection.hpp"
#include "geoloc/geometry/time.hpp"
#include "geoloc/state/vehicle_state.hpp"

namespace geoloc::apps {

inline constexpr std::size_t kNoStateReasons = 5;  ///< of NoState

struct HostTimeSpan {
  HostTime first;
  HostTime last;
};

/// What a run was given, in counts that show whether it was meant so (diagnosis.hpp).
struct RunCensus {
  std::optional<HostTimeSpan> telemetry;  ///< when it was received
  std::optional<HostTimeSpan> frames;     ///< when they were taken

  std::uint64_t frame_count = 0;
  std::uint64_t frames_without_vehicle = 0;                           ///< its clock was not known
  std::array<std::uint64_t, kNoStateReasons> frames_without_state{};  ///< by NoState

  std::uint64_t boxes = 0;
  std::uint64_t boxes_within_a_pixel = 0;  ///< neither side is longer than one
  std::uint64_t boxes_beyond_image = 0;    ///< they end outside of it
  /// They reach farther from their left and top edge than those are from the image's, as all boxes do that
  /// are given by two corners.
  std::uint64_t boxes_like_corners = 0;
};

void note_telemetry(RunCensus& census, HostTime received_at);

/// A frame and its detections, whatever becomes of it.
void note_frame(RunCensus& census, HostTime captured_at, const std::vector<Detection>& detections,
                const CameraIntrinsics& image);

}  // namespace geoloc::apps
