// SPDX-License-Identifier: Apache-2.0
#include "app/detection_worker.hpp"

#include <utility>

namespace geoloc::apps {
namespace {

constexpr std::size_t kLongestQueue = 64;

}  // namespace

DetectionWorker::DetectionWorker(io::VideoSource& source, io::Detector& detector,
                                 const CameraIntrinsics& camera, const io::HostClock& clock,
                                 OnDetected on_detected)
    : source_(source),
      detector_(detector),
      camera_(camera),
      clock_(clock),
      on_detected_(std::move(on_detected)),
      thread_([this] { run(); }) {}

DetectionWorker::~DetectionWorker() {
  stop_ = true;
  thread_.join();
}

void DetectionWorker::run() {
  while (!stop_) {
    const auto frame = source_.next(std::chrono::milliseconds{100});
    if (frame) {
      detect(*frame);
    } else if (source_.status().state == io::VideoState::kEnded) {
      ended_ = true;
      return;
    }
  }
}

bool DetectionWorker::fits_calibration(const cv::Mat& picture) {
  const bool fits = picture.cols == camera_.width_px && picture.rows == camera_.height_px;
  const std::lock_guard lock(mutex_);
  if (fits) {
    stats_.wrong_size_message.clear();
    return true;
  }
  ++stats_.wrong_size;
  stats_.wrong_size_message = "frames are " + std::to_string(picture.cols) + " x " +
                              std::to_string(picture.rows) + ", but the camera is calibrated for " +
                              std::to_string(camera_.width_px) + " x " + std::to_string(camera_.height_px) +
                              ": give this stream's calibration (\"camera\" in --config)";
  return false;
}

void DetectionWorker::detect(const io::VideoFrame& frame) {
  if (frame.damaged) {
    const std::lock_guard lock(mutex_);
    ++stats_.damaged;
    return;
  }
  if (!fits_calibration(frame.bgr)) return;
  const HostTime started = clock_.now();
  DetectedFrame result;
  result.captured_at = frame.captured_at;
  result.received_at = frame.received_at;
  result.time_quality = frame.time_quality;
  result.detections = detector_.detect(frame.bgr);
  result.searched_at = clock_.now();
  result.telemetry = frame.telemetry;
  const double took_ms = 1e3 * seconds(result.searched_at - started);
  if (on_detected_) on_detected_(frame, result.detections);

  const std::lock_guard lock(mutex_);
  ++stats_.detected;
  stats_.detections += result.detections.size();
  stats_.detect_ms.add(took_ms);
  if (queue_.size() >= kLongestQueue) {
    queue_.erase(queue_.begin());
    ++stats_.overflowed;
  }
  queue_.push_back(std::move(result));
}

std::vector<DetectedFrame> DetectionWorker::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(queue_, {});
}

DetectionWorker::Stats DetectionWorker::stats() const {
  const std::lock_guard lock(mutex_);
  return stats_;
}

}  // namespace geoloc::apps
