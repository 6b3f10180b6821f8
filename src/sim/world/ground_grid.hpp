// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "geoloc/camera/camera.hpp"
#include "geoloc/geometry/rigid3.hpp"

namespace geoloc::sim {

/// Where the lines of sight of every eighth pixel meet the ground. Between nodes the ground is interpolated
/// bilinearly: at 40 deg of tilt that is off by 0.02 px, at 75 deg by 0.1 px.
class GroundGrid {
 public:
  static constexpr int kStep_px = 8;

  struct Node {
    Eigen::Vector2f offset_m =
        Eigen::Vector2f::Zero();  ///< of the ground point from origin_in_enu(), east and north
    float range_m = 0.0f;
    float upward = 0.0f;  ///< sine of the elevation of the line of sight
    bool on_ground = false;
  };

  explicit GroundGrid(const CameraModel& camera);

  /// From now on through that camera, whose image is as large.
  void look_through(const CameraModel& camera);

  /// Computes all nodes for a pose, which must be finite.
  void look_from(const Rigid3d& enu_from_camera);

  /// Node (column, row) sits at pixel kStep_px * column - kStep_px + 3.5, so the outermost nodes lie outside
  /// of the image and the pixels between two nodes are whole.
  static double pixel_of(int index) { return kStep_px * (index - 1) + 0.5 * (kStep_px - 1); }

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  const Node& node(int column, int row) const { return nodes_[index(column, row)]; }

  /// Number of all nodes, and of one among them, row by row.
  std::size_t size() const { return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_); }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  /// All four corners of the cell right of and below the node see the ground.
  bool cell_on_ground(int column, int row) const;

  /// Box around the four corners of that cell, relative to the origin.
  Eigen::AlignedBox2f cell_box(int column, int row) const {
    const Eigen::Vector2f &a = node(column, row).offset_m, &b = node(column + 1, row).offset_m;
    const Eigen::Vector2f &c = node(column, row + 1).offset_m, &d = node(column + 1, row + 1).offset_m;
    return {a.cwiseMin(b).cwiseMin(c.cwiseMin(d)), a.cwiseMax(b).cwiseMax(c.cwiseMax(d))};
  }

  /// Length [m] on the ground of a pixel of that cell, which must see the ground; mean of both directions.
  float footprint_m(int column, int row) const;

  /// Below the camera.
  const Eigen::Vector2d& origin_in_enu() const { return origin_in_enu_; }

  /// Box around all ground nodes, relative to the origin.
  const Eigen::AlignedBox2f& extent_m() const { return extent_m_; }

 private:
  int columns_;
  int rows_;
  std::vector<Eigen::Vector3f> bearings_;  // camera; zero where the lens has none
  std::vector<Node> nodes_;
  Eigen::Vector2d origin_in_enu_ = Eigen::Vector2d::Zero();
  Eigen::AlignedBox2f extent_m_;
};

}  // namespace geoloc::sim
