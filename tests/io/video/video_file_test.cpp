// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/video/video_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "geoloc/io/video/file_source.hpp"
#include "support/temporary_folder.hpp"

namespace geoloc::io {
namespace {

using std::chrono::milliseconds;

constexpr int kPictures = 12;

cv::Mat grey(int level, cv::Size size) {
  return cv::Mat(size, CV_8UC3, cv::Scalar::all(level));
}

/// Expects each picture to come back with the brightness of its number, at its time.
void expect_comes_back(const std::filesystem::path& file, cv::Size size) {
  const HostClock clock;
  FileSource source{file, {Pace::kAsTaken, HostTime{}}, {}, clock};
  for (int i = 0; i < kPictures; ++i) {
    const auto frame = source.next(std::chrono::seconds{40});
    ASSERT_TRUE(frame) << i;
    EXPECT_EQ(frame->bgr.size(), size);
    EXPECT_NEAR(cv::mean(frame->bgr)[1], 40 + 15 * i, 3.0) << i;
    EXPECT_NEAR(seconds(frame->captured_at.time_since_epoch()), 0.07 * i, 0.002) << i;
  }
  EXPECT_FALSE(source.next(std::chrono::seconds{40}));
}

TEST(VideoFile, PlaysWhatWasAddedAtItsTime) {
  const testing::TemporaryFolder folder;
  for (const cv::Size size : {cv::Size{160, 120}, cv::Size{161, 91}}) {
    const auto file = folder.path() / (std::to_string(size.width) + ".mkv");
    VideoFile video(file, size);
    for (int i = 0; i < kPictures; ++i)
      video.add(grey(40 + 15 * i, i % 3 == 2 ? cv::Size{80, 60} : size), milliseconds{70 * i});
    EXPECT_FALSE(std::filesystem::exists(file));
    video.finish();
    expect_comes_back(file, size);
  }
}

VideoTelemetry telemetry_of_picture(int number) {
  VideoTelemetry telemetry;
  telemetry.made_at = CameraTime{std::chrono::seconds{1'790'000'000} + milliseconds{70 * number}};
  telemetry.vehicle = {{0.0, 0.0, 0.01 * number}, milliseconds{number}};
  telemetry.zoom = 1.0 + number;
  return telemetry;
}

TEST(VideoFile, TelemetryComesBackWithItsPicture) {
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "a.mkv";
  VideoFile video(file, {160, 120});
  ASSERT_TRUE(video.takes_telemetry());
  for (int i = 0; i < kPictures; ++i) {
    const bool has_telemetry = i != 5;
    video.add(grey(40 + 15 * i, {160, 120}), milliseconds{70 * i},
              has_telemetry ? std::optional(telemetry_of_picture(i)) : std::nullopt);
  }
  video.finish();
  expect_comes_back(file, {160, 120});
  const HostClock clock;
  FileSource source{file, {Pace::kAsTaken, HostTime{}}, {}, clock};
  for (int i = 0; i < kPictures; ++i) {
    const auto frame = source.next(std::chrono::seconds{40});
    ASSERT_TRUE(frame) << i;
    ASSERT_EQ(frame->telemetry.has_value(), i != 5) << i;
    if (!frame->telemetry) continue;
    EXPECT_EQ(to_json(frame->telemetry->record), to_json(telemetry_of_picture(i))) << i;
  }
  EXPECT_EQ(source.status().with_telemetry, kPictures - 1U);
  EXPECT_EQ(source.take_telemetry().size(), kPictures - 1U);
  EXPECT_TRUE(source.take_telemetry().empty());
}

TEST(VideoFile, JpegTakesNoTelemetry) {
  const testing::TemporaryFolder folder;
  VideoFile video(folder.path() / "a.mkv", {161, 91});
  EXPECT_FALSE(video.takes_telemetry());
  video.add(grey(100, {161, 91}), milliseconds{0}, telemetry_of_picture(1));
  video.finish();
  const HostClock clock;
  FileSource source{folder.path() / "a.mkv", {Pace::kAsTaken, HostTime{}}, {}, clock};
  const auto frame = source.next(std::chrono::seconds{40});
  ASSERT_TRUE(frame);
  EXPECT_FALSE(frame->telemetry);
}

TEST(VideoFile, ThatIsNotFinishedIsNotLeftBehind) {
  const testing::TemporaryFolder folder;
  {
    VideoFile video(folder.path() / "a.mkv", {160, 120});
    video.add(grey(100, {160, 120}), milliseconds{0});
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(VideoFile, ThatCannotBeWrittenIsNamedAndHoldsNobodyUp) {
  for (const char* file : {"/no such folder/a.mkv", "/dev/full/a.mkv"}) {
    try {
      VideoFile video(file, {640, 480});
      for (int i = 0; i < 100; ++i) video.add(grey(i, {640, 480}), milliseconds{40 * i});
      video.finish();
      FAIL() << file;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(file), std::string::npos) << error.what();
    }
  }
}

/// Limits the size of this process' files, as on a full disk.
class FullDisk {
 public:
  explicit FullDisk(rlim_t most_bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{most_bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  void (*handler_)(int);
  rlimit before_{};
};

TEST(VideoFile, OnAFullDiskIsToldAndHoldsNobodyUp) {
  const testing::TemporaryFolder folder;
  const FullDisk full(100'000);
  cv::Mat noise(480, 640, CV_8UC3);
  EXPECT_THROW(
      {
        VideoFile video(folder.path() / "a.mkv", noise.size());
        for (int i = 0; i < 60; ++i) {
          cv::randu(noise, 0, 255);
          video.add(noise, milliseconds{40 * i});
        }
        video.finish();
      },
      std::runtime_error);
}

}  // namespace
}  // namespace geoloc::io
