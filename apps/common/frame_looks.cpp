// SPDX-License-Identifier: Apache-2.0
#include "common/frame_looks.hpp"

#include <algorithm>

#include "geoloc/projection/projector.hpp"
#include "geoloc/tracking/assignment.hpp"

namespace geoloc::apps {
namespace {

std::optional<Eigen::Vector2d> pixel_of(const Track& object, const Geolocator& geolocator) {
  return geolocator.projector().reproject(position_in_view(object, geolocator), geolocator.view());
}

struct ShownObject {
  std::uint64_t id;
  Eigen::Vector2d pixel;
};

/// The objects that the frame showed, some of them for the first time.
std::vector<ShownObject> shown_in(const Geolocator& geolocator, HostTime captured_at) {
  std::vector<ShownObject> shown;
  for (const Track& object : geolocator.tracks()) {
    if (object.last_seen != captured_at) continue;
    if (const auto pixel = pixel_of(object, geolocator)) shown.push_back({object.id, *pixel});
  }
  return shown;
}

Eigen::MatrixXd distances_px(const std::vector<LocatedDetection>& detections,
                             const std::vector<ShownObject>& objects) {
  Eigen::MatrixXd distances(static_cast<Eigen::Index>(detections.size()),
                            static_cast<Eigen::Index>(objects.size()));
  for (std::size_t k = 0; k < objects.size(); ++k) {
    for (std::size_t i = 0; i < detections.size(); ++i)
      distances(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          (detections[i].detection.box.centre() - objects[k].pixel).norm();
  }
  return distances;
}

}  // namespace

Eigen::Vector3d position_in_view(const Track& object, const Geolocator& geolocator) {
  const Eigen::Vector2d& mean = object.position_in_enu.mean;
  const double ground_m = geolocator.projector().config().ground_height_above_home_m;
  const double height_m = object.height ? object.height->above_home_m + geolocator.view().lifted_m : ground_m;
  return {mean.x(), mean.y(), height_m};
}

std::vector<io::Look> FrameLooks::looks(const Geolocator& geolocator, HostTime captured_at) const {
  const std::vector<LocatedDetection>& detections = geolocator.located();
  std::vector<io::Look> looks(detections.size());
  const std::vector<ShownObject> shown = shown_in(geolocator, captured_at);
  if (shown.empty() || detections.empty()) return looks;
  const CameraIntrinsics& image = geolocator.projector().camera().intrinsics();
  AssignmentSolver solver;
  const auto& object_of = solver.solve(distances_px(detections, shown), image.width_px);
  for (std::size_t i = 0; i < detections.size(); ++i) {
    if (object_of[i] == AssignmentSolver::kUnassigned) continue;
    looks[i].object_id = shown[object_of[i]].id;
    const auto before = std::find_if(expected_.begin(), expected_.end(),
                                     [&](const Track& object) { return object.id == looks[i].object_id; });
    if (before != expected_.end()) looks[i].expected_px = pixel_of(*before, geolocator);
  }
  return looks;
}

}  // namespace geoloc::apps
