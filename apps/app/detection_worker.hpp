// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/running_mean.hpp"
#include "geoloc/camera/camera.hpp"
#include "geoloc/io/detection/detector.hpp"
#include "geoloc/io/host_clock.hpp"
#include "geoloc/io/video/video_source.hpp"

namespace geoloc::apps {

/// A frame after the detector.
struct DetectedFrame {
  HostTime captured_at;
  HostTime received_at;
  HostTime searched_at{};  ///< when the detector was done
  io::TimeQuality time_quality = io::TimeQuality::kArrival;
  std::vector<Detection> detections;
  std::optional<io::FrameTelemetry> telemetry;  ///< where the frame carries any
};

/// Takes the newest frame of a source, detects, and queues the result, in a thread of its own. Damaged frames
/// and frames that the camera's calibration does not fit are counted and go no further.
class DetectionWorker {
 public:
  struct Stats {
    std::uint64_t detected = 0;    ///< frames searched
    std::uint64_t detections = 0;  ///< found in them
    std::uint64_t damaged = 0;
    std::uint64_t wrong_size = 0;
    std::uint64_t overflowed = 0;    ///< queued results nobody took in time
    RunningMean detect_ms;           ///< of one frame
    std::string wrong_size_message;  ///< for the user; empty where the last frame has the right size
  };

  /// Called in the worker's thread with each frame that was searched; must be quick.
  using OnDetected =
      std::function<void(const io::VideoFrame& frame, const std::vector<Detection>& detections)>;

  /// Source, detector and clock must outlive the worker. Starts at once.
  DetectionWorker(io::VideoSource& source, io::Detector& detector, const CameraIntrinsics& camera,
                  const io::HostClock& clock, OnDetected on_detected = {});
  ~DetectionWorker();
  DetectionWorker(const DetectionWorker&) = delete;
  DetectionWorker& operator=(const DetectionWorker&) = delete;

  /// What was detected since the last call, in order.
  std::vector<DetectedFrame> take();

  /// The source has ended and all of its frames are queued or taken.
  bool has_ended() const { return ended_; }

  Stats stats() const;

 private:
  void run();
  void detect(const io::VideoFrame& frame);
  bool fits_calibration(const cv::Mat& picture);

  io::VideoSource& source_;
  io::Detector& detector_;
  CameraIntrinsics camera_;
  const io::HostClock& clock_;
  OnDetected on_detected_;
  std::atomic<bool> stop_{false};
  std::atomic<bool> ended_{false};
  mutable std::mutex mutex_;  // guards what follows
  std::vector<DetectedFrame> queue_;
  Stats stats_;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace geoloc::apps
