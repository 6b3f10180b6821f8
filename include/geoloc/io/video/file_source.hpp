// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "geoloc/io/encoded_video.hpp"
#include "geoloc/io/host_clock.hpp"
#include "geoloc/io/video/video_config.hpp"
#include "geoloc/io/video/video_source.hpp"

namespace geoloc::io {

enum class Pace {
  kRealTime,  ///< like a camera: a slow caller misses frames
  kAsTaken    ///< every frame, as fast as they are taken
};

struct Playback {
  Pace pace = Pace::kRealTime;
  std::optional<HostTime> starts_at;  ///< capture time of the file's time 0; without it, playing starts now
};

/// What a file tells of the whole of it.
struct FileFacts {
  std::optional<HostTime> created_at;  ///< UTC as the camera's clock had it, mostly in whole seconds
  std::optional<Duration> duration;
};

/// A video file of any container and codec that GStreamer has a plugin for (mkv, mp4, avi, …). Capture time
/// is the start plus the frame's time stamp. Ends with VideoState::kEnded; last_error is set if not all of
/// the file could be played.
class FileSource final : public VideoSource {
 public:
  /// Throws std::runtime_error naming the file and the reason if it holds no decodable video. Only the size
  /// limit of `config` is used. `clock` must outlive the source. `taker` gets the video as it is in the file,
  /// if it is H.264 or H.265; nullptr: nobody wants it.
  FileSource(const std::filesystem::path& file, const Playback& playback, const VideoConfig& config,
             const HostClock& clock, std::shared_ptr<EncodedVideoTaker> taker = nullptr);
  ~FileSource() override;
  FileSource(const FileSource&) = delete;
  FileSource& operator=(const FileSource&) = delete;

  std::optional<VideoFrame> next(Duration timeout) override;
  std::vector<FrameTelemetry> take_telemetry() override;
  VideoStatus status() const override;

  /// Known from the beginning.
  FileFacts facts() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace geoloc::io
