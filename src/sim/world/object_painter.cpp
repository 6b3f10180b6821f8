// SPDX-License-Identifier: Apache-2.0
#include "object_painter.hpp"

#include <algorithm>
#include <array>

#include "appearance.hpp"

namespace geoloc::sim {
namespace {

constexpr int kSamples = 3;  // along each side of a pixel

/// Corners of a grid cell in the object's axes [m].
struct CellInObject {
  Eigen::Vector2f top_left, top_right, low_left, low_right;

  /// right, down: 0..1 within the cell.
  Eigen::Vector2f at(float right, float down) const {
    const Eigen::Vector2f top = top_left + right * (top_right - top_left);
    const Eigen::Vector2f low = low_left + right * (low_right - low_left);
    return top + down * (low - top);
  }

  bool may_meet(const Eigen::Vector2f& half_extent_m) const {
    const Eigen::Vector2f least = top_left.cwiseMin(top_right).cwiseMin(low_left.cwiseMin(low_right));
    const Eigen::Vector2f most = top_left.cwiseMax(top_right).cwiseMax(low_left.cwiseMax(low_right));
    return (least.array() < half_extent_m.array()).all() && (most.array() > -half_extent_m.array()).all();
  }
};

/// Mean over the pixel's area; x, y count the pixels within the cell.
Surface mean_surface(const PlacedObject& object, const CellInObject& cell, int x, int y) {
  Surface mean{{0.0f, 0.0f, 0.0f}, 0.0f};
  for (int j = 0; j < kSamples; ++j) {
    const float down =
        (static_cast<float>(y) + (static_cast<float>(j) + 0.5f) / kSamples) / GroundGrid::kStep_px;
    for (int i = 0; i < kSamples; ++i) {
      const float right =
          (static_cast<float>(x) + (static_cast<float>(i) + 0.5f) / kSamples) / GroundGrid::kStep_px;
      const Surface sample = surface_at(object, cell.at(right, down));
      mean.reflectance += sample.coverage * sample.reflectance;
      mean.coverage += sample.coverage;
    }
  }
  const Eigen::Vector2f middle = cell.at((static_cast<float>(x) + 0.5f) / GroundGrid::kStep_px,
                                         (static_cast<float>(y) + 0.5f) / GroundGrid::kStep_px);
  if (mean.coverage > 0.0f) mean.reflectance *= wear_at(object, middle) / mean.coverage;
  mean.coverage /= kSamples * kSamples;
  return mean;
}

void paint_cell(const GroundGrid& grid, const Light& light, const PlacedObject& object,
                const CellInObject& cell, int column, int row, cv::Mat& image) {
  const int left = GroundGrid::kStep_px * column - GroundGrid::kStep_px / 2,
            top = GroundGrid::kStep_px * row - GroundGrid::kStep_px / 2;  // of the cell in the image
  for (int y = std::max(0, -top); y < std::min(GroundGrid::kStep_px, image.rows - top); ++y) {
    for (int x = std::max(0, -left); x < std::min(GroundGrid::kStep_px, image.cols - left); ++x) {
      const Surface surface = mean_surface(object, cell, x, y);
      if (!(surface.coverage > 0.0f)) continue;
      const Eigen::Array3f grey = light.seen(surface.reflectance, grid, column, row);
      cv::Vec3b& pixel = image.at<cv::Vec3b>(top + y, left + x);
      for (int k = 0; k < 3; ++k) {
        pixel[k] = cv::saturate_cast<std::uint8_t>(static_cast<float>(pixel[k]) * (1.0f - surface.coverage) +
                                                   grey[k] * surface.coverage);
      }
    }
  }
}

}  // namespace

void paint_object(const GroundGrid& grid, const Light& light, const PlacedObject& object, cv::Mat& image) {
  const Eigen::Vector2f half_m = half_extent_m(object);
  const Eigen::Vector2f centre_m = (object.position_in_enu - grid.origin_in_enu()).cast<float>();
  if (!(grid.extent_m().exteriorDistance(centre_m) < half_m.norm())) return;
  const Eigen::Vector2f reach_m = Eigen::Vector2f::Constant(half_m.norm());
  const Eigen::AlignedBox2f around(centre_m - reach_m, centre_m + reach_m);
  const Eigen::Matrix2f turn = object_from_enu(object).cast<float>();
  const auto in_object = [&](int column, int row) -> Eigen::Vector2f {
    return turn * (grid.node(column, row).offset_m - centre_m);
  };
  for (int row = 0; row + 1 < grid.rows(); ++row) {
    for (int column = 0; column + 1 < grid.columns(); ++column) {
      if (!around.intersects(grid.cell_box(column, row)))
        continue;  // most cells: before anything is computed
      const CellInObject cell{in_object(column, row), in_object(column + 1, row), in_object(column, row + 1),
                              in_object(column + 1, row + 1)};
      if (!cell.may_meet(half_m) || !grid.cell_on_ground(column, row)) continue;
      paint_cell(grid, light, object, cell, column, row, image);
    }
  }
}

}  // namespace geoloc::sim
