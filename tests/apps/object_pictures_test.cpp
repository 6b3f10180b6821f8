// SPDX-License-Identifier: Apache-2.0
#include "app/object_pictures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <set>

namespace geoloc::apps {
namespace {

constexpr int kWidth_px = 640;
constexpr int kHeight_px = 480;

double worth(const Box& box, double confidence = 0.8) {
  return picture_worth({box, confidence, 0}, kWidth_px, kHeight_px);
}

TEST(PictureWorth, IsGreaterForWhatIsLargerSurerAndWhole) {
  const Box box{100.0, 100.0, 40.0, 30.0};
  EXPECT_GT(worth({100.0, 100.0, 80.0, 60.0}), worth(box));
  EXPECT_GT(worth(box, 0.9), worth(box, 0.8));
  for (const Box& cut_off : {Box{0.0, 100.0, 60.0, 30.0}, Box{100.0, 0.0, 60.0, 30.0},
                             Box{600.0, 100.0, 40.0, 30.0}, Box{100.0, 450.0, 60.0, 30.0}})
    EXPECT_GT(worth(box), worth(cut_off));
}

/// A vehicle that hovers 20 m above the ground with a camera that looks down.
class Hover : public ::testing::Test {
 protected:
  Hover() : geolocator(config()) {}

  /// Its state up to that time, ten times a second.
  void hover_until(Duration since_begin) {
    for (; hovered_for <= since_begin; hovered_for += std::chrono::milliseconds{100}) {
      geolocator.add(AttitudeSample{VehicleTime{hovered_for}, {0.0, 0.0, 0.0}});
      PositionSample position;
      position.time = VehicleTime{hovered_for};
      position.position = {45.0, 7.0};
      position.height_above_home_m = 20.0;
      geolocator.add(position);
    }
  }

  static GeolocatorConfig config() {
    GeolocatorConfig config;
    config.camera.intrinsics = CameraIntrinsics::from_field_of_view(kWidth_px, kHeight_px, 70.0);
    return config;
  }

  /// A frame that shows one thing in a colour, searched and located.
  void see(int frame_number, const Box& box, const cv::Scalar& colour, ObjectPictures& pictures) {
    const Duration since_begin = std::chrono::milliseconds{1000 + 100 * frame_number};
    hover_until(since_begin + std::chrono::seconds{1});
    io::VideoFrame video;
    video.captured_at = HostTime{since_begin};
    video.bgr = cv::Mat(kHeight_px, kWidth_px, CV_8UC3, colour);
    const std::vector<Detection> detections{{box, 0.9, 0}};
    pictures.offer(video, detections);
    FrameDetections frame;
    frame.captured_at = VehicleTime{since_begin};
    frame.captured_at_host = video.captured_at;
    frame.detections = detections;
    static_cast<void>(geolocator.process(frame));  // located or not
    pictures.assign(geolocator, video.captured_at);
  }

  Geolocator geolocator;
  Duration hovered_for{};
};

TEST_F(Hover, TheBestPictureOfAnObjectIsTheLastThatIsGiven) {
  std::map<std::uint64_t, std::vector<cv::Mat>> given;
  {
    ObjectPictures pictures(
        [&given](std::uint64_t id, const std::string& jpeg) {
          const std::vector<unsigned char> bytes(jpeg.begin(), jpeg.end());
          given[id].push_back(cv::imdecode(bytes, cv::IMREAD_COLOR));
        },
        [](std::uint64_t) {});
    see(0, {300.0, 220.0, 20.0, 20.0}, {255.0, 0.0, 0.0}, pictures);
    see(1, {290.0, 210.0, 40.0, 40.0}, {0.0, 255.0, 0.0}, pictures);  // larger
    see(2, {300.0, 220.0, 20.0, 20.0}, {0.0, 0.0, 255.0}, pictures);  // worse again
  }
  ASSERT_EQ(given.size(), 1U);
  const std::vector<cv::Mat>& pictures = given.begin()->second;
  ASSERT_EQ(pictures.size(), 2U);
  EXPECT_GT(pictures.back().at<cv::Vec3b>(24, 24)[1], 200);  // the green one
  EXPECT_EQ(pictures.back().cols, 80);
}

/// Hours of false detections must not fill the memory with pictures of what is not there.
TEST_F(Hover, NoPictureIsLeftOfWhatIsNoObjectAnyMore) {
  std::set<std::uint64_t> left, given;
  {
    ObjectPictures pictures(
        [&](std::uint64_t id, const std::string& /*jpeg*/) {
          left.insert(id);
          given.insert(id);
        },
        [&left](std::uint64_t id) { left.erase(id); });  // one that was never given may be forgotten, too
    for (int number = 0; number < 500; ++number) {
      const double x_px = 20.0 + 45.0 * (number % 13), y_px = 20.0 + 40.0 * (number % 11);  // 143 places
      see(number, {x_px, y_px, 20.0, 20.0}, {255.0, 0.0, 0.0}, pictures);
    }
  }
  std::set<std::uint64_t> objects;
  for (const Track& track : geolocator.tracks()) objects.insert(track.id);
  EXPECT_TRUE(std::includes(objects.begin(), objects.end(), left.begin(), left.end()));
  EXPECT_GT(given.size(), left.size());  // some came and went
}

TEST_F(Hover, FramesThatAreNeverLocatedTakeBoundedMemory) {
  ObjectPictures pictures([](std::uint64_t /*id*/, const std::string& /*jpeg*/) {}, [](std::uint64_t) {});
  io::VideoFrame video;
  video.bgr = cv::Mat(1080, 1920, CV_8UC3, cv::Scalar());
  const std::vector<Detection> large(16, {{100.0, 40.0, 1000.0, 1000.0}, 0.9, 0});
  for (int number = 0; number < 100; ++number) {  // 5 GB of pieces
    video.captured_at = HostTime{std::chrono::milliseconds{number}};
    pictures.offer(video, large);
  }
  EXPECT_LT(pictures.waiting_bytes(), 64U << 20);
}

TEST_F(Hover, AFrameThatWasNotLocatedGivesNone) {
  int given = 0;
  {
    ObjectPictures pictures([&given](std::uint64_t /*id*/, const std::string& /*jpeg*/) { ++given; },
                            [](std::uint64_t) {});
    io::VideoFrame video;
    video.captured_at = HostTime{std::chrono::seconds{1}};
    video.bgr = cv::Mat(kHeight_px, kWidth_px, CV_8UC3, cv::Scalar());
    pictures.offer(video, {{{300.0, 220.0, 20.0, 20.0}, 0.9, 0}});
    pictures.assign(geolocator, HostTime{std::chrono::seconds{2}});
  }
  EXPECT_EQ(given, 0);
}

}  // namespace
}  // namespace geoloc::apps
