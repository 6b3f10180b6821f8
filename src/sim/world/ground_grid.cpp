// SPDX-License-Identifier: Apache-2.0
#include "ground_grid.hpp"

namespace geoloc::sim {
namespace {

constexpr float kFarthest_m = 5000.0f;  // beyond, all is haze

int nodes_across(int pixels) {
  return (pixels + GroundGrid::kStep_px - 1) / GroundGrid::kStep_px + 2;
}

}  // namespace

GroundGrid::GroundGrid(const CameraModel& camera)
    : columns_(nodes_across(camera.intrinsics().width_px)),
      rows_(nodes_across(camera.intrinsics().height_px)) {
  look_through(camera);
  nodes_.resize(bearings_.size());
}

void GroundGrid::look_through(const CameraModel& camera) {
  bearings_.clear();
  bearings_.reserve(size());
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const auto ray = camera.ray({pixel_of(column), pixel_of(row)});
      bearings_.push_back(ray ? ray->normalized.homogeneous().normalized().cast<float>().eval()
                              : Eigen::Vector3f::Zero().eval());
    }
  }
}

void GroundGrid::look_from(const Rigid3d& enu_from_camera) {
  const Eigen::Matrix3f rotation = enu_from_camera.rotation.normalized().toRotationMatrix().cast<float>();
  const auto height_m = static_cast<float>(enu_from_camera.translation.z());
  origin_in_enu_ = enu_from_camera.translation.head<2>();
  extent_m_.setEmpty();
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Eigen::Vector3f direction = rotation * bearings_[i];
    Node& node = nodes_[i];
    node.upward = direction.z();
    node.range_m = direction.z() < 0.0f ? -height_m / direction.z() : 0.0f;
    node.on_ground = node.range_m > 0.0f && node.range_m < kFarthest_m;
    node.offset_m =
        node.on_ground ? (node.range_m * direction.head<2>()).eval() : Eigen::Vector2f::Zero().eval();
    if (node.on_ground) extent_m_.extend(node.offset_m);
  }
}

bool GroundGrid::cell_on_ground(int column, int row) const {
  return node(column, row).on_ground && node(column + 1, row).on_ground && node(column, row + 1).on_ground &&
         node(column + 1, row + 1).on_ground;
}

float GroundGrid::footprint_m(int column, int row) const {
  const Eigen::Vector2f& corner = node(column, row).offset_m;
  const float across = (node(column + 1, row).offset_m - corner).norm();
  const float down = (node(column, row + 1).offset_m - corner).norm();
  return 0.5f * (across + down) / static_cast<float>(kStep_px);
}

}  // namespace geoloc::sim
