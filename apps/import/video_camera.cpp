// SPDX-License-Identifier: Apache-2.0
#include "import/video_camera.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "geoloc/io/json/camera_file.hpp"
#include "geoloc/io/stills/still.hpp"

namespace geoloc::apps {
namespace {

/// As of a picture that tells no more.
std::optional<io::Lens> film_lens(const VideoFacts& video, double focal_35mm_mm) {
  io::PictureTags tags;
  tags.width_px = video.width_px;
  tags.height_px = video.height_px;
  tags.exif["FocalLengthIn35mmFilm"] = fmt::format("{}", focal_35mm_mm);
  return io::lens_of(tags);
}

CameraConfig camera_of_view(const VideoFacts& video, const ToldCamera& told,
                            std::vector<std::string>& assumptions) {
  CameraConfig camera;
  camera.intrinsics =
      CameraIntrinsics::from_field_of_view(video.width_px, video.height_px, *told.horizontal_fov_deg);
  if (told.is_on_gimbal) camera.mount = CameraMount::on_gimbal();
  assumptions.push_back(fmt::format(
      "the camera is the one that the video tells, with a nominal field of view of {:.1f} deg, {}: heights, "
      "and positions away from the image's middle, are as uncertain (--camera gives a calibration)",
      *told.horizontal_fov_deg, told.is_on_gimbal ? "on a gimbal" : "looking straight down"));
  return camera;
}

}  // namespace

CameraConfig video_camera(const std::string& camera_file, const VideoFacts& video, const ToldCamera& told,
                          std::vector<std::string>& assumptions) {
  if (!camera_file.empty()) {
    const CameraConfig camera = io::read_camera_file(camera_file);
    const CameraIntrinsics& size = camera.intrinsics;
    if (size.width_px != video.width_px || size.height_px != video.height_px)
      throw std::runtime_error(
          fmt::format("{}: is of pictures of {} x {}, and the video's are {} x {}: calibrate "
                      "the camera in its video mode",
                      camera_file, size.width_px, size.height_px, video.width_px, video.height_px));
    if (told.is_on_gimbal && camera.mount.kind != MountKind::kGimbal)
      assumptions.push_back(camera_file +
                            ": says that the camera is fixed in the vehicle, so how the gimbal looks is not "
                            "used (\"mount\": {\"kind\": \"gimbal\"})");
    return camera;
  }
  if (told.horizontal_fov_deg) return camera_of_view(video, told, assumptions);
  const auto lens = told.focal_35mm_mm ? film_lens(video, *told.focal_35mm_mm) : std::nullopt;
  if (!lens)
    throw std::runtime_error(
        "the camera's focal length is not known: give its calibration with --camera (a file with width, "
        "height "
        "and horizontal_fov_deg will do: docs/formats.md, camera.json)");
  assumptions.push_back(
      fmt::format("the focal length is the log's equivalent for film of 35 mm, {:.0f} px to some 5 % where "
                  "the whole width of the "
                  "sensor is used: heights, and positions away from the image's middle, are as uncertain "
                  "(--camera gives a "
                  "calibration)",
                  lens->intrinsics.fx_px));
  CameraConfig camera;
  camera.intrinsics = lens->intrinsics;
  return camera;
}

}  // namespace geoloc::apps
