// SPDX-License-Identifier: Apache-2.0
#include "mip_atlas.hpp"

#include <opencv2/imgproc.hpp>

namespace geoloc::sim {

MipAtlas::MipAtlas(const cv::Mat& tile, double texel_m) : texel_m_(texel_m), period_m_(texel_m * tile.cols) {
  const int size = tile.cols;
  // The halved sizes stand in one column beside the tile; each has its first row and column once more at its
  // end, because bilinear interpolation reads one texel further.
  image_ = cv::Mat::zeros(2 * size + 16, size + 1 + size / 2 + 1, CV_8UC3);
  cv::Mat level = tile;
  int left = 0, top = 0;
  for (std::size_t index = 0; index < levels_.size(); ++index) {
    const int side = level.cols;
    cv::Mat padded;
    cv::copyMakeBorder(level, padded, 0, 1, 0, 1, cv::BORDER_WRAP);
    padded.copyTo(image_(cv::Rect(left, top, side + 1, side + 1)));
    levels_[index] = {
        static_cast<float>(1 << kFractionBits) * static_cast<float>(side) / static_cast<float>(size),
        (side << kFractionBits) - 1, left, top};
    last_level_ = static_cast<int>(index);
    if (side == 1) break;
    top = index == 0 ? 0 : top + side + 1;
    left = size + 1;
    cv::Mat half;
    cv::resize(level, half, {side / 2, side / 2}, 0, 0, cv::INTER_AREA);
    level = half;
  }
  image_ = image_(cv::Rect(0, 0, image_.cols, std::max(size + 1, top + 2))).clone();
}

}  // namespace geoloc::sim
