// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>

namespace geoloc::sim {

/// A texture that repeats for ever, with every halved size of it, in one image: one cv::remap draws from all
/// levels.
class MipAtlas {
 public:
  /// tile: square, side a power of two up to 4096, CV_8UC3, periodic.
  MipAtlas(const cv::Mat& tile, double texel_m);

  /// Writes the entry of cv::remap's fixed-point maps (CV_16SC2, CV_16UC1) for the texel coordinates x, y of
  /// the full-size tile, any finite value within +-2^24; level in [0, last_level()].
  void locate(float x, float y, int level, cv::Vec2s& whole, std::uint16_t& fraction) const {
    const Level& at = levels_[static_cast<std::size_t>(level)];
    const int x_fixed = static_cast<int>(x * at.scale) & at.mask;
    const int y_fixed = static_cast<int>(y * at.scale) & at.mask;
    whole = {static_cast<short>(at.left + (x_fixed >> kFractionBits)),
             static_cast<short>(at.top + (y_fixed >> kFractionBits))};
    fraction =
        static_cast<std::uint16_t>(((y_fixed & kFractionMask) << kFractionBits) | (x_fixed & kFractionMask));
  }

  const cv::Mat& image() const { return image_; }
  double texel_m() const { return texel_m_; }
  double period_m() const { return period_m_; }
  int last_level() const { return last_level_; }

 private:
  static constexpr int kFractionBits = 5;  // cv::INTER_BITS
  static constexpr int kFractionMask = (1 << kFractionBits) - 1;

  struct Level {
    float scale;  // fixed-point units of this level a texel of the full tile
    int mask;
    int left;
    int top;
  };

  cv::Mat image_;
  std::array<Level, 13> levels_{};
  double texel_m_;
  double period_m_;
  int last_level_ = 0;
};

}  // namespace geoloc::sim
