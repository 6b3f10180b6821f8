// SPDX-License-Identifier: Apache-2.0
#include "app/detection_worker.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

namespace geoloc::apps {
namespace {

/// Gives frames of the sizes asked for, then ends.
class ListedFrames final : public io::VideoSource {
 public:
  explicit ListedFrames(std::deque<io::VideoFrame> frames) : frames_(std::move(frames)) {}

  std::optional<io::VideoFrame> next(Duration /*timeout*/) override {
    if (frames_.empty()) return std::nullopt;
    io::VideoFrame frame = frames_.front();
    frames_.pop_front();
    return frame;
  }

  io::VideoStatus status() const override {
    io::VideoStatus status;
    status.state = io::VideoState::kEnded;
    return status;
  }

 private:
  std::deque<io::VideoFrame> frames_;
};

class BlindDetector final : public io::Detector {
 public:
  std::vector<Detection> detect(const cv::Mat& /*bgr*/) override { return {}; }
  io::DetectorCounts counts() const override { return {}; }
  const std::vector<std::string>& class_names() const override { return names_; }

 private:
  std::vector<std::string> names_;
};

io::VideoFrame frame(int width_px, bool is_damaged = false) {
  io::VideoFrame frame;
  frame.bgr = cv::Mat::zeros(48, width_px, CV_8UC3);
  frame.damaged = is_damaged;
  return frame;
}

struct Seen {
  DetectionWorker::Stats stats;
  std::vector<DetectedFrame> frames;
};

/// For a camera that is calibrated for 64 x 48 px.
Seen work_on(std::deque<io::VideoFrame> frames) {
  const io::HostClock clock;
  ListedFrames source(std::move(frames));
  BlindDetector detector;
  DetectionWorker worker(source, detector, CameraIntrinsics::from_field_of_view(64, 48, 60.0), clock);
  while (!worker.has_ended()) std::this_thread::sleep_for(std::chrono::milliseconds{1});
  return {worker.stats(), worker.take()};
}

TEST(DetectionWorker, SaysThatFramesHaveAWrongSizeUntilOneHasTheRightOne) {
  const Seen wrong = work_on({frame(64), frame(32)});
  EXPECT_NE(wrong.stats.wrong_size_message.find("32 x 48"), std::string::npos);
  EXPECT_EQ(wrong.stats.wrong_size, 1U);
  const Seen right_again = work_on({frame(32), frame(64)});
  EXPECT_EQ(right_again.stats.wrong_size_message, "");
  EXPECT_EQ(right_again.stats.wrong_size, 1U);
}

TEST(DetectionWorker, LeavesDamagedFramesOutAndCountsThem) {
  const Seen seen = work_on({frame(64, true), frame(64), frame(64, true), frame(64, true), frame(64)});
  ASSERT_EQ(seen.frames.size(), 2U);
  EXPECT_EQ(seen.stats.detected, 2U);
  EXPECT_EQ(seen.stats.damaged, 3U);
}

}  // namespace
}  // namespace geoloc::apps
