// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/world/visible_boxes.hpp"

#include <Eigen/Geometry>
#include <optional>

#include "appearance.hpp"

namespace geoloc::sim {
namespace {

Eigen::Vector3d on_ground(const Eigen::Vector2d& position_in_enu) {
  return {position_in_enu.x(), position_in_enu.y(), 0.0};
}

/// Box around the projected corners in the camera's coordinates (pixel centres at integers); nullopt where
/// one of them has no projection.
std::optional<Eigen::AlignedBox2d> outline_px(const CameraModel& camera, const Rigid3d& camera_from_enu,
                                              const PlacedObject& object) {
  const Eigen::Matrix2d enu_from_object = object_from_enu(object).transpose();
  const Eigen::Vector2d half_m = half_extent_m(object).cast<double>();
  Eigen::AlignedBox2d outline;
  for (const double forward : {-1.0, 1.0}) {
    for (const double right : {-1.0, 1.0}) {
      const Eigen::Vector2d corner_m =
          enu_from_object * Eigen::Vector2d(forward * half_m.x(), right * half_m.y());
      const auto pixel = camera.pixel(camera_from_enu * on_ground(object.position_in_enu + corner_m));
      if (!pixel) return std::nullopt;
      outline.extend(*pixel);
    }
  }
  return outline;
}

Box box_of(const Eigen::AlignedBox2d& pixels) {
  const Eigen::Vector2d size = pixels.sizes();
  return {pixels.min().x() + 0.5, pixels.min().y() + 0.5, size.x(), size.y()};
}

}  // namespace

std::optional<VisibleBox> visible_box(const CameraModel& camera, const Rigid3d& enu_from_camera,
                                      const std::vector<PlacedObject>& objects, std::size_t index) {
  if (!(enu_from_camera.translation.z() > 0.0)) return std::nullopt;  // the ground is seen from above only
  const Rigid3d camera_from_enu = enu_from_camera.inverse();
  const CameraIntrinsics& intrinsics = camera.intrinsics();
  const Eigen::AlignedBox2d image(Eigen::Vector2d(-0.5, -0.5),
                                  Eigen::Vector2d(intrinsics.width_px - 0.5, intrinsics.height_px - 0.5));
  const auto centre = camera.pixel(camera_from_enu * on_ground(objects[index].position_in_enu));
  const auto whole = outline_px(camera, camera_from_enu, objects[index]);
  if (!centre || !whole) return std::nullopt;
  const Eigen::AlignedBox2d part = whole->intersection(image);
  const double fraction = part.isEmpty() ? 0.0 : part.volume() / whole->volume();
  if (!(fraction > 0.0)) return std::nullopt;
  return VisibleBox{index, box_of(*whole), box_of(part), fraction, *centre};
}

std::vector<VisibleBox> visible_boxes(const CameraModel& camera, const Rigid3d& enu_from_camera,
                                      const std::vector<PlacedObject>& objects) {
  std::vector<VisibleBox> boxes;
  for (std::size_t index = 0; index < objects.size(); ++index) {
    if (objects[index].kind != ObjectKind::kFiducial) continue;
    if (const auto box = visible_box(camera, enu_from_camera, objects, index)) boxes.push_back(*box);
  }
  return boxes;
}

}  // namespace geoloc::sim
