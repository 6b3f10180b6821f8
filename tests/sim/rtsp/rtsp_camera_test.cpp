// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/rtsp/rtsp_camera.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

#include "geoloc/io/host_clock.hpp"
#include "geoloc/io/video/rtsp_source.hpp"

namespace geoloc::sim {
namespace {

using SteadyTime = std::chrono::steady_clock::time_point;

constexpr int kWidth_px = 320, kHeight_px = 240, kCell_px = 32, kBits = 8;

/// A number as black and white squares in the top row, large enough to survive the encoder.
std::vector<std::uint8_t> picture_of(int number) {
  std::vector<std::uint8_t> bgr(std::size_t{3} * kWidth_px * kHeight_px, 128);
  for (int y = 0; y < kCell_px; ++y) {
    for (int x = 0; x < kBits * kCell_px; ++x) {
      const std::uint8_t grey = (number >> (x / kCell_px) & 1) != 0 ? 235 : 16;
      std::fill_n(&bgr[3 * static_cast<std::size_t>(y * kWidth_px + x)], 3, grey);
    }
  }
  return bgr;
}

int number_in(const cv::Mat& bgr) {
  int number = 0;
  for (int bit = 0; bit < kBits; ++bit) {
    const auto& pixel = bgr.at<cv::Vec3b>(kCell_px / 2, bit * kCell_px + kCell_px / 2);
    if (pixel[1] > 127) number |= 1 << bit;
  }
  return number;
}

RtspCameraSettings small_camera() {
  RtspCameraSettings settings;
  settings.port = 0;
  settings.width_px = kWidth_px;
  settings.height_px = kHeight_px;
  settings.frame_rate_hz = 20.0;
  return settings;
}

/// Pushes numbered pictures at 20 Hz until it is destroyed, and keeps their time stamps.
class Painter {
 public:
  explicit Painter(RtspCamera& camera) : thread_([this, &camera] { run(camera); }) {}
  ~Painter() {
    stop_ = true;
    thread_.join();
  }

  SteadyTime stamp_of(int number) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return stamps_.at(number);
  }

 private:
  void run(RtspCamera& camera) {
    for (int number = 0; !stop_; number = (number + 1) % (1 << kBits)) {
      const SteadyTime stamp = std::chrono::steady_clock::now();
      {
        const std::lock_guard<std::mutex> lock(mutex_);
        stamps_[number] = stamp;
      }
      io::VideoTelemetry telemetry;
      telemetry.zoom = number + 1.0;
      camera.push(picture_of(number).data(), stamp, telemetry);
      std::this_thread::sleep_for(std::chrono::milliseconds{50});
    }
  }

  std::mutex mutex_;
  std::map<int, SteadyTime> stamps_;
  std::atomic<bool> stop_{false};
  std::thread thread_;  // the last member: it uses the others
};

TEST(RtspCamera, StreamTellsTheStampOfEachPicture) {
  const io::HostClock clock;
  RtspCamera camera(small_camera());
  Painter painter(camera);
  io::RtspSource receiver(camera.url(), io::VideoConfig{}, clock);
  int recovered = 0;
  while (recovered < 10) {
    const auto frame = receiver.next(std::chrono::seconds{1});
    if (!frame || frame->time_quality != io::TimeQuality::kRecovered) continue;
    const HostTime expected = clock.at(painter.stamp_of(number_in(frame->bgr)));
    EXPECT_NEAR(seconds(frame->captured_at - expected), 0.0, 0.002);
    ++recovered;
  }
}

TEST(RtspCamera, TelemetryComesWithItsPicture) {
  const io::HostClock clock;
  RtspCamera camera(small_camera());
  Painter painter(camera);
  io::RtspSource receiver(camera.url(), io::VideoConfig{}, clock);
  for (int checked = 0; checked < 20;) {
    const auto frame = receiver.next(std::chrono::seconds{1});
    if (!frame) continue;
    ASSERT_TRUE(frame->telemetry);
    EXPECT_EQ(frame->telemetry->record.zoom, number_in(frame->bgr) + 1.0);
    EXPECT_EQ(frame->telemetry->made_at <= frame->received_at, true);
    ++checked;
  }
  EXPECT_GE(receiver.take_telemetry().size(), 20U);
}

TEST(RtspCamera, KnowsWhetherSomeoneWatchesAndServesTheNextOne) {
  const io::HostClock clock;
  RtspCamera camera(small_camera());
  EXPECT_FALSE(camera.is_watched());
  EXPECT_FALSE(camera.push(picture_of(0).data(), std::chrono::steady_clock::now()));
  Painter painter(camera);
  for (int visit = 0; visit < 2; ++visit) {
    {
      io::RtspSource receiver(camera.url(), io::VideoConfig{}, clock);
      while (!receiver.next(std::chrono::seconds{1})) {
      }
      EXPECT_TRUE(camera.is_watched());
    }
    while (camera.is_watched()) std::this_thread::sleep_for(std::chrono::milliseconds{10});
  }
}

TEST(RtspCamera, SaysThatAPortIsInUse) {
  const RtspCamera first(small_camera());
  RtspCameraSettings settings = small_camera();
  const std::string url = first.url();
  settings.port = static_cast<std::uint16_t>(std::stoi(url.substr(url.rfind(':') + 1)));
  try {
    const RtspCamera second(settings);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("--rtsp-port " + std::to_string(settings.port)),
              std::string::npos);
  }
}

TEST(RtspCamera, RefusesPicturesThatCannotBeEncoded) {
  RtspCameraSettings settings = small_camera();
  settings.width_px = 321;
  settings.frame_rate_hz = 0.0;
  EXPECT_EQ(settings.problems().size(), 2U);
  EXPECT_THROW(RtspCamera{settings}, std::invalid_argument);
}

}  // namespace
}  // namespace geoloc::sim
