// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/camera/detection.hpp"
#include "geoloc/geometry/time.hpp"

namespace geoloc::io {

/// A frame of the video as a page shows it.
struct LivePicture {
  std::string jpeg;  ///< may be smaller than the frame
  int frame_width_px = 0;
  int frame_height_px = 0;
  HostTime captured_at;
  std::vector<Detection> detections;  ///< boxes in the frame's pixels
};

/// The newest picture, for pages that show it. Thread-safe.
class PictureBoard {
 public:
  /// `class_names` are for the boxes; a class without a name is shown as its number.
  PictureBoard(std::vector<std::string> class_names, std::chrono::milliseconds period);

  /// Whether a page is watching and the last picture is old enough; otherwise there is no need to make one.
  bool wants_picture() const;

  /// Returns its number, from 1.
  std::uint64_t show(LivePicture picture);

  /// A page is watching: pictures are wanted for the next few seconds.
  void note_viewer();

  /// JSON of the boxes and the picture in one piece: 4 bytes of the JSON's length (little endian), the JSON,
  /// the JPEG. nullptr before the first.
  std::shared_ptr<const std::string> framed() const;

 private:
  using Clock = std::chrono::steady_clock;

  const std::vector<std::string> class_names_;
  const std::chrono::milliseconds period_;
  mutable std::mutex mutex_;  // guards what follows
  std::optional<Clock::time_point> viewed_at_;
  std::optional<Clock::time_point> shown_at_;
  std::uint64_t number_ = 0;
  std::shared_ptr<const std::string> framed_;
};

}  // namespace geoloc::io
