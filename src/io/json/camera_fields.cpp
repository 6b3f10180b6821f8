// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/json/camera_fields.hpp"

#include <nlohmann/json.hpp>

#include "camera/camera_fields.hpp"
#include "io/json/field_reader.hpp"
#include "io/json/field_writer.hpp"
#include "settings/rules.hpp"

namespace geoloc::io {
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
  constexpr Range kRange = Range::open(0, 175);
  const auto& value = object[kFieldOfView];
  const double fov_deg = value.is_number() ? value.get<double>() : 0.0;
  if (!kRange.contains(fov_deg)) {
    problems.push_back(name + " must lie in " + to_text(kRange) + ", but is " + value.dump().substr(0, 60));
    return;
  }
  const auto distortion = camera.intrinsics.distortion;
  camera.intrinsics =
      CameraIntrinsics::from_field_of_view(camera.intrinsics.width_px, camera.intrinsics.height_px, fov_deg);
  camera.intrinsics.distortion = distortion;
}

/// Angles of a camera fixed to the body mean nothing on a gimbal: one that was not on it begins at 0.
void begin_on_gimbal(const nlohmann::json& mount_object, CameraMount& mount) {
  const bool is_on_gimbal =
      mount_object.is_object() && mount_object.value("kind", nlohmann::json()) == name_of(MountKind::kGimbal);
  if (is_on_gimbal && mount.kind != MountKind::kGimbal) mount = CameraMount::on_gimbal();
}

}  // namespace

nlohmann::ordered_json camera_to_json(const CameraConfig& camera) {
  return fields_to_json(camera);
}

nlohmann::ordered_json mount_to_json(const CameraMount& mount) {
  return fields_to_json(mount);
}

void mount_from_json(const nlohmann::json& object, const std::string& path, CameraMount& mount,
                     std::vector<std::string>& problems) {
  begin_on_gimbal(object, mount);
  FieldReader reader(object, path, problems);
  visit_fields(reader, mount);
}

void camera_from_json(const nlohmann::json& object, const std::string& path, bool strict,
                      CameraConfig& camera, std::vector<std::string>& problems) {
  nlohmann::json numbers = object;
  const bool has_field_of_view = object.is_object() && object.contains(kFieldOfView);
  if (has_field_of_view) numbers.erase(kFieldOfView);
  if (numbers.is_object() && numbers.contains("mount")) begin_on_gimbal(numbers["mount"], camera.mount);
  FieldReader reader(numbers, path, problems);
  visit_fields(reader, camera);
  if (strict) reader.refuse_unknown();
  if (has_field_of_view) apply_field_of_view(object, path, camera, problems);
}

}  // namespace geoloc::io
