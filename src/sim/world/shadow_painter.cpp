// SPDX-License-Identifier: Apache-2.0
#include "shadow_painter.hpp"

#include <opencv2/imgproc.hpp>

namespace geoloc::sim {
namespace {

/// Each side in so many pieces, since a lens bends it.
constexpr int kPieces = 8;

std::vector<cv::Point> projected(const CameraModel& camera, const Rigid3d& camera_from_enu,
                                 const std::vector<Eigen::Vector2d>& outline_in_enu) {
  constexpr double kFar_px = 10000.0;  // beyond, the drawing's integers would overflow
  std::vector<cv::Point> outline;
  for (std::size_t i = 0; i < outline_in_enu.size(); ++i) {
    const Eigen::Vector2d &from = outline_in_enu[i], &to = outline_in_enu[(i + 1) % outline_in_enu.size()];
    for (int piece = 0; piece < kPieces; ++piece) {
      const Eigen::Vector2d at = from + (to - from) * piece / kPieces;
      const auto pixel = camera.pixel(camera_from_enu * Eigen::Vector3d(at.x(), at.y(), 0.0));
      if (!pixel || !(pixel->cwiseAbs().maxCoeff() < kFar_px)) return {};
      outline.emplace_back(cvRound(pixel->x()), cvRound(pixel->y()));
    }
  }
  return outline;
}

}  // namespace

void cast_shadow(const CameraModel& camera, const Rigid3d& enu_from_camera, const Shadow& shadow,
                 cv::Mat& image) {
  const auto outline = projected(camera, enu_from_camera.inverse(), shadow.outline_in_enu);
  if (outline.empty()) return;
  cv::Mat light(image.size(), CV_8UC1, cv::Scalar(255));
  cv::fillPoly(light, std::vector<std::vector<cv::Point>>{outline},
               cv::Scalar(255.0 * (1.0 - shadow.darkness)));
  if (shadow.penumbra_px > 0.0) cv::GaussianBlur(light, light, {}, shadow.penumbra_px);
  cv::cvtColor(light, light, cv::COLOR_GRAY2BGR);
  cv::multiply(image, light, image, 1.0 / 255.0);
}

}  // namespace geoloc::sim
