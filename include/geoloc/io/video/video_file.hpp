// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>

#include "geoloc/geometry/time.hpp"

namespace geoloc::io {

/// Writes a video file: Matroska, with H.264 where GStreamer has x264enc and the pictures' sides are even,
/// with JPEG otherwise. The file appears whole, at finish().
class VideoFile {
 public:
  /// Pictures have the size of the first one. Throws std::runtime_error naming the file and the reason.
  VideoFile(std::filesystem::path file, cv::Size size);

  /// What was not finished is not left behind.
  ~VideoFile();
  VideoFile(const VideoFile&) = delete;
  VideoFile& operator=(const VideoFile&) = delete;

  /// `bgr`: 8 bits, 3 channels; another size is scaled to the first one's. `time`: from the beginning, later
  /// than that of the picture before. Waits while the encoder is behind. Throws std::runtime_error as the
  /// constructor.
  void add(const cv::Mat& bgr, Duration time);

  /// Waits for the encoder, and gives the file its name. Nothing can be added afterwards.
  void finish();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace geoloc::io
