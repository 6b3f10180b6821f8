// SPDX-License-Identifier: Apache-2.0
#include "ground_painter.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace geoloc::sim {
namespace {

/// Turns the patches against the grain, so that the two never repeat together.
const Eigen::Matrix2f kPatchesFromEnu = Eigen::Rotation2Df(0.58f).toRotationMatrix();

/// Texel coordinates of the grid's origin within one period, in double: far from the world's origin float
/// would blur.
Eigen::Vector2f origin_texel(const GroundGrid& grid, const MipAtlas& texture,
                             const Eigen::Matrix2f& texture_from_enu) {
  Eigen::Vector2d at = texture_from_enu.cast<double>() * grid.origin_in_enu();
  at -= texture.period_m() * (at / texture.period_m()).array().floor().matrix();
  return (at / texture.texel_m()).cast<float>();
}

/// Level whose texels are as large as the footprint, not yet rounded.
float level_of(float footprint_m, const MipAtlas& texture) {
  const float level = std::log2(footprint_m / static_cast<float>(texture.texel_m()));
  return std::clamp(level, 0.0f, static_cast<float>(texture.last_level()));
}

/// Thresholds in 0..1 that spread the rounding of levels over neighbouring pixels, so that no edge shows
/// where one level meets the next.
constexpr float kDither[4][4] = {{0.03f, 0.53f, 0.16f, 0.66f},
                                 {0.78f, 0.28f, 0.91f, 0.41f},
                                 {0.22f, 0.72f, 0.09f, 0.59f},
                                 {0.97f, 0.47f, 0.84f, 0.34f}};

}  // namespace

GroundPainter::GroundPainter(const GroundGrid& grid) {
  const cv::Size nodes(grid.columns(), grid.rows());
  const cv::Size cells((nodes.width - 1) * GroundGrid::kStep_px, (nodes.height - 1) * GroundGrid::kStep_px);
  patches_at_ = {cv::Mat(nodes, CV_16SC2), cv::Mat(nodes, CV_16UC1)};
  grain_at_ = {cv::Mat(cells, CV_16SC2), cv::Mat(cells, CV_16UC1)};
}

void GroundPainter::paint(const GroundGrid& grid, const Ground& ground, const Light& light, cv::Mat& image) {
  locate_patches(grid, ground.patches);
  cv::remap(ground.patches.image(), patches_, patches_at_.whole, patches_at_.fraction, cv::INTER_LINEAR);
  light_patches(grid, light);
  cv::resize(patches_, base_, {}, GroundGrid::kStep_px, GroundGrid::kStep_px, cv::INTER_LINEAR);
  locate_grain(grid, ground.grain);
  cv::remap(ground.grain.image(), grain_, grain_at_.whole, grain_at_.fraction, cv::INTER_LINEAR);
  const cv::Rect seen_in_base(GroundGrid::kStep_px, GroundGrid::kStep_px, image.cols,
                              image.rows);  // a node's cell reaches half a step each way
  const cv::Rect seen_in_grain(GroundGrid::kStep_px / 2, GroundGrid::kStep_px / 2, image.cols, image.rows);
  cv::multiply(base_(seen_in_base), grain_(seen_in_grain), image, 1.0 / kGrainUnity);
}

void GroundPainter::locate_patches(const GroundGrid& grid, const MipAtlas& patches) {
  const Eigen::Vector2f origin = origin_texel(grid, patches, kPatchesFromEnu);
  const Eigen::Matrix2f texel_from_m = kPatchesFromEnu / static_cast<float>(patches.texel_m());
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      const int cell_column = std::min(column, grid.columns() - 2), cell_row = std::min(row, grid.rows() - 2);
      int level = patches.last_level();
      if (grid.cell_on_ground(cell_column, cell_row)) {
        level = static_cast<int>(
            level_of(GroundGrid::kStep_px * grid.footprint_m(cell_column, cell_row), patches));
      }
      const Eigen::Vector2f texel = origin + texel_from_m * grid.node(column, row).offset_m;
      patches.locate(texel.x(), texel.y(), level, patches_at_.whole.at<cv::Vec2s>(row, column),
                     patches_at_.fraction.at<std::uint16_t>(row, column));
    }
  }
}

void GroundPainter::light_patches(const GroundGrid& grid, const Light& light) {
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      cv::Vec3b& patch = patches_.at<cv::Vec3b>(row, column);
      const Eigen::Array3f reflectance = Eigen::Array3f(patch[0], patch[1], patch[2]) / 255.0f;
      const bool on_ground = grid.node(column, row).on_ground;
      const Eigen::Array3f grey =
          on_ground ? light.seen(reflectance, grid, column, row) : light.sky(grid, column, row);
      for (int k = 0; k < 3; ++k) patch[k] = cv::saturate_cast<std::uint8_t>(grey[k]);
    }
  }
}

void GroundPainter::locate_grain(const GroundGrid& grid, const MipAtlas& grain) {
  const Eigen::Vector2f origin = origin_texel(grid, grain, Eigen::Matrix2f::Identity());
  const float texel_from_m = 1.0f / static_cast<float>(grain.texel_m());
  for (int cell_row = 0; cell_row + 1 < grid.rows(); ++cell_row) {
    for (int cell_column = 0; cell_column + 1 < grid.columns(); ++cell_column) {
      const bool on_ground = grid.cell_on_ground(cell_column, cell_row);
      const float level = on_ground ? level_of(grid.footprint_m(cell_column, cell_row), grain)
                                    : static_cast<float>(grain.last_level());
      const Eigen::Vector2f top_left = origin + texel_from_m * grid.node(cell_column, cell_row).offset_m;
      const Eigen::Vector2f top_right = origin + texel_from_m * grid.node(cell_column + 1, cell_row).offset_m;
      const Eigen::Vector2f low_left = origin + texel_from_m * grid.node(cell_column, cell_row + 1).offset_m;
      const Eigen::Vector2f low_right =
          origin + texel_from_m * grid.node(cell_column + 1, cell_row + 1).offset_m;
      for (int y = 0; y < GroundGrid::kStep_px; ++y) {
        const float down = (static_cast<float>(y) + 0.5f) / GroundGrid::kStep_px;
        const Eigen::Vector2f left = top_left + down * (low_left - top_left);
        const Eigen::Vector2f stride =
            (top_right + down * (low_right - top_right) - left) / GroundGrid::kStep_px;
        auto* whole = grain_at_.whole.ptr<cv::Vec2s>(cell_row * GroundGrid::kStep_px + y) +
                      cell_column * GroundGrid::kStep_px;
        auto* fraction = grain_at_.fraction.ptr<std::uint16_t>(cell_row * GroundGrid::kStep_px + y) +
                         cell_column * GroundGrid::kStep_px;
        for (int x = 0; x < GroundGrid::kStep_px; ++x) {
          const float right = static_cast<float>(x) + 0.5f;
          const int rounded = std::min(static_cast<int>(level + kDither[y % 4][x % 4]), grain.last_level());
          grain.locate(left.x() + right * stride.x(), left.y() + right * stride.y(), rounded, whole[x],
                       fraction[x]);
        }
      }
    }
  }
}

}  // namespace geoloc::sim
