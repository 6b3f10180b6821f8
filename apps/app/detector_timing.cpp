// SPDX-License-Identifier: Apache-2.0
#include "app/detector_timing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <opencv2/core.hpp>

namespace geoloc::apps {
namespace {

constexpr int kPictures = 7;  // after the first, for which the network's memory is laid out

double search_time_ms(io::Detector& detector, const cv::Mat& picture) {
  const auto begin = std::chrono::steady_clock::now();
  detector.detect(picture);
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

std::string time_detector(const LiveOptions& options) {
  const LiveConfig config = load_config(options).config;
  const CameraIntrinsics& camera = config.estimation.geolocator.camera.intrinsics;
  const auto detector = io::open_detector(detector_files(options.detector), config.detection);
  const cv::Mat picture(camera.height_px, camera.width_px, CV_8UC3, cv::Scalar::all(128));
  search_time_ms(*detector, picture);
  std::array<double, kPictures> times_ms{};
  for (double& time_ms : times_ms) time_ms = search_time_ms(*detector, picture);
  const auto middle = times_ms.begin() + kPictures / 2;
  std::nth_element(times_ms.begin(), middle, times_ms.end());
  return fmt::format("{:.0f} ms per picture of {} x {}, which is {:.1f} pictures per second", *middle,
                     camera.width_px, camera.height_px, 1e3 / *middle);
}

}  // namespace geoloc::apps
