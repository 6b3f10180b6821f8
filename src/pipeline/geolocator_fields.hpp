// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "camera/camera_fields.hpp"
#include "geoloc/pipeline/geolocator_config.hpp"
#include "projection/projector_fields.hpp"
#include "settings/rules.hpp"
#include "state/state_fields.hpp"
#include "tracking/joint_tracker_fields.hpp"
#include "tracking/known_point_fields.hpp"
#include "tracking/paper_tracker_fields.hpp"

namespace geoloc {

template <>
struct EnumNames<CameraOrientation> {
  static constexpr std::array<std::pair<CameraOrientation, const char*>, 2> all{
      {{CameraOrientation::kComposed, "composed"}, {CameraOrientation::kAddedAngles, "added_angles"}}};
};

template <>
struct EnumNames<Method> {
  static constexpr std::array<std::pair<Method, const char*>, 2> all{
      {{Method::kPaper, "paper"}, {Method::kJoint, "joint"}}};
};

/// Whether a margin of that width leaves something of the image. An image without a size is no matter of
/// this.
inline bool is_within_image(double margin_px, const CameraIntrinsics& image) {
  const int size_px = std::min(image.width_px, image.height_px);
  return !kImageSize.contains(size_px) || 2.0 * margin_px < size_px;
}

template <class Visitor>
void visit_fields(Visitor& v, GeolocatorConfig& config) {
  constexpr const char* kWithinImage = "must be less than half of the image's width and height";
  const CameraIntrinsics& image = config.camera.intrinsics;
  v.field(
      "method", config.method, Any{}, "",
      "Objects, calibration and drift estimated together (joint), or one Kalman filter per object (paper)");
  v.field("camera_orientation", config.camera_orientation, Any{}, "",
          "The mount turns in the body (composed), or its angles are added to the vehicle's (added_angles) "
          "as in the "
          "paper's eq. 6, which is wrong when the vehicle tilts");
  v.field("max_detections", config.max_detections, Range::closed(1, 10000), "",
          "Most detections per frame; of more, the most confident are used");
  v.field("edge_margin_px", config.edge_margin_px, Range::closed(0, Range::kInfinity), "px",
          "Boxes nearer to the image's edge may be cut by it and are not used; 0 uses all");
  v.relation("edge_margin_px", config.edge_margin_px, is_within_image(config.edge_margin_px, image),
             kWithinImage);
  v.section("state", config.state);
  v.section("projector", config.projector);
  v.section("paper", config.paper);
  v.relation("paper.visible_margin_px", config.paper.visible_margin_px,
             config.method != Method::kPaper || is_within_image(config.paper.visible_margin_px, image),
             kWithinImage);
  v.section("joint", config.joint);
  v.section("camera", config.camera);
  v.list("known_points", config.known_points, "Surveyed objects, for the joint method");
}

}  // namespace geoloc
