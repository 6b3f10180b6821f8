// SPDX-License-Identifier: Apache-2.0
#include "detect/drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace geoloc::apps {
namespace {

constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr int kSubpixelBits = 4;

/// Okabe and Ito's colours, told apart by everyone; blue, green, red.
cv::Scalar colour_of(int class_id) {
  static const std::array kColours{
      cv::Scalar{66, 228, 240},  cv::Scalar{233, 180, 86}, cv::Scalar{0, 159, 230}, cv::Scalar{115, 158, 0},
      cv::Scalar{167, 121, 204}, cv::Scalar{0, 94, 213},   cv::Scalar{178, 114, 0}};
  return kColours[static_cast<std::size_t>(class_id) % kColours.size()];
}

/// Of continuous coordinates, in sixteenths of OpenCV's pixels, whose centres are at integers.
cv::Point subpixel(double x, double y) {
  constexpr double kScale = 1 << kSubpixelBits;
  return {static_cast<int>(std::lround((x - 0.5) * kScale)),
          static_cast<int>(std::lround((y - 0.5) * kScale))};
}

/// OpenCV's letters are those of ASCII.
std::string label_of(const Detection& detection, const std::vector<std::string>& class_names) {
  constexpr std::size_t kLongest = 24;
  std::string name = class_names[static_cast<std::size_t>(detection.class_id)].substr(0, kLongest);
  const auto is_unprintable = [](char c) { return c < ' ' || c > '~'; };
  std::replace_if(name.begin(), name.end(), is_unprintable, '?');
  return fmt::format("{} {:.2f}", name, detection.confidence);
}

void draw_label(cv::Mat& bgr, const Box& box, const std::string& label, const cv::Scalar& colour,
                double scale) {
  const int thickness = std::max(1, static_cast<int>(std::lround(scale)));
  int baseline = 0;
  const cv::Size size = cv::getTextSize(label, kFont, 0.45 * scale, thickness, &baseline);
  const int height = size.height + baseline + thickness;
  const int left = std::clamp(static_cast<int>(box.x), 0, std::max(0, bgr.cols - size.width));
  const int above = static_cast<int>(box.y) - height;
  const int top = above >= 0 ? above : std::min(static_cast<int>(box.y + box.height) + 1, bgr.rows - height);
  cv::rectangle(bgr, {left, top, size.width, height}, colour, cv::FILLED);
  cv::putText(bgr, label, {left, top + size.height}, kFont, 0.45 * scale, cv::Scalar::all(0), thickness,
              cv::LINE_AA);
}

}  // namespace

void draw_detections(cv::Mat& bgr, const std::vector<Detection>& detections,
                     const std::vector<std::string>& class_names) {
  const double scale =
      std::max(1.0, std::max(bgr.cols, bgr.rows) / 1280.0);  // lines that a screen still shows
  const int thickness = std::max(1, static_cast<int>(std::lround(scale)));
  for (const Detection& detection : detections) {
    const Box& box = detection.box;
    const cv::Scalar colour = colour_of(detection.class_id);
    cv::rectangle(bgr, subpixel(box.x, box.y), subpixel(box.x + box.width, box.y + box.height), colour,
                  thickness, cv::LINE_AA, kSubpixelBits);
    cv::circle(bgr, subpixel(box.x + 0.5 * box.width, box.y + 0.5 * box.height),
               static_cast<int>(1.5 * scale * (1 << kSubpixelBits)), colour, cv::FILLED, cv::LINE_AA,
               kSubpixelBits);
    draw_label(bgr, box, label_of(detection, class_names), colour, scale);
  }
}

}  // namespace geoloc::apps
