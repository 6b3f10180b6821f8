// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "geoloc/geometry/time.hpp"
#include "geoloc/io/sei/video_telemetry.hpp"

namespace geoloc::io {

/// Writes a video file: Matroska, with H.264 where GStreamer has x264enc and h264parse and the pictures'
/// sides are even, with JPEG otherwise. The file appears whole, at finish().
class VideoFile {
 public:
  /// Pictures have the size of the first one. `created_at` is what the file tells of when it was recorded, in
  /// whole seconds; without it, now. Throws std::runtime_error naming the file and the reason.
  VideoFile(std::filesystem::path file, cv::Size size, std::optional<HostTime> created_at = std::nullopt);

  /// Removes the file if it was not finished.
  ~VideoFile();
  VideoFile(const VideoFile&) = delete;
  VideoFile& operator=(const VideoFile&) = delete;

  /// `bgr` has 8 bits and 3 channels; other sizes are scaled to that of the first picture. `time` is from the
  /// beginning, later than that of the previous picture. `telemetry`, where there is any, goes into the
  /// frame, which JPEG cannot. Waits while the encoder is behind. Throws std::runtime_error as the
  /// constructor.
  void add(const cv::Mat& bgr, Duration time, const std::optional<VideoTelemetry>& telemetry = std::nullopt);

  /// Whether its frames can have telemetry.
  bool takes_telemetry() const;

  /// Waits for the encoder and gives the file its final name. Nothing can be added afterwards.
  void finish();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace geoloc::io
