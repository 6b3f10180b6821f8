// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/json/camera_fields.hpp"

#include <nlohmann/json.hpp>

#include "geoloc/io/json/fields.hpp"

namespace geoloc {

template <class Visitor>
void visit_fields(Visitor& v, CameraMount& mount) {
  v.field("roll_deg", mount.roll_deg, "deg, applied last");
  v.field("pitch_deg", mount.pitch_deg, "deg, -90 looks straight down");
  v.field("yaw_deg", mount.yaw_deg, "deg, clockwise from the nose, applied first");
  v.field("x_m", mount.x_m, "m, lever arm forward");
  v.field("y_m", mount.y_m, "m, lever arm right");
  v.field("z_m", mount.z_m, "m, lever arm down");
}

template <class Visitor>
void visit_fields(Visitor& v, CameraConfig& camera) {
  v.field("width", camera.intrinsics.width_px, "px");
  v.field("height", camera.intrinsics.height_px, "px");
  v.field("fx", camera.intrinsics.fx_px, "px");
  v.field("fy", camera.intrinsics.fy_px, "px");
  v.field("cx", camera.intrinsics.cx_px, "px, pixel centres at integers");
  v.field("cy", camera.intrinsics.cy_px, "px");
  v.field("distortion", camera.intrinsics.distortion, "k1 k2 p1 p2 k3 as OpenCV's");
  v.section("mount", camera.mount);
}

namespace io {
namespace {

constexpr const char* kFieldOfView = "horizontal_fov_deg";

/// Replaces fx fy cx cy by the values that follow from the field of view.
void apply_field_of_view(const nlohmann::json& object, const std::string& path, CameraConfig& camera,
                         std::vector<std::string>& problems) {
  const std::string name = path.empty() ? kFieldOfView : path + "." + kFieldOfView;
  for (const char* key : {"fx", "fy", "cx", "cy"}) {
    if (object.contains(key)) {
      problems.push_back(name + " and " + key + " exclude each other: give one or the other");
      return;
    }
  }
  const auto& value = object[kFieldOfView];
  const double fov_deg = value.is_number() ? value.get<double>() : 0.0;
  if (!(fov_deg > 0.0 && fov_deg < 175.0)) {
    problems.push_back(name + " must lie in (0, 175)");
    return;
  }
  const auto distortion = camera.intrinsics.distortion;
  camera.intrinsics =
      CameraIntrinsics::from_field_of_view(camera.intrinsics.width_px, camera.intrinsics.height_px, fov_deg);
  camera.intrinsics.distortion = distortion;
}

}  // namespace

nlohmann::ordered_json camera_to_json(const CameraConfig& camera) {
  FieldWriter writer;
  CameraConfig copy = camera;  // one description serves reading and writing, so it takes mutable fields
  visit_fields(writer, copy);
  return writer.take();
}

void camera_from_json(const nlohmann::json& object, const std::string& path, bool strict,
                      CameraConfig& camera, std::vector<std::string>& problems) {
  nlohmann::json numbers = object;
  const bool has_field_of_view = object.is_object() && object.contains(kFieldOfView);
  if (has_field_of_view) numbers.erase(kFieldOfView);
  FieldReader reader(numbers, path, problems);
  visit_fields(reader, camera);
  if (strict) reader.refuse_unknown();
  if (has_field_of_view) apply_field_of_view(object, path, camera, problems);
}

}  // namespace io
}  // namespace geoloc
