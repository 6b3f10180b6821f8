// SPDX-License-Identifier: Apache-2.0
#include "import/video_camera.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "geoloc/io/json/camera_file.hpp"
#include "geoloc/io/stills/still.hpp"

namespace geoloc::apps {
namespace {

/// 1-sigma of a focal length by the equivalent for film of 35 mm: videos are cut from the sensor, and not all
/// from its whole width.
constexpr double kFilmSigma_percent = 5.0;
/// The same by a nominal field of view, as data sheets have it.
constexpr double kViewSigma_percent = 3.0;

/// As of a picture that tells no more.
std::optional<io::Lens> film_lens(const VideoFacts& video, double focal_35mm_mm) {
  io::PictureTags tags;
  tags.width_px = video.width_px;
  tags.height_px = video.height_px;
  tags.exif["FocalLengthIn35mmFilm"] = fmt::format("{}", focal_35mm_mm);
  return io::lens_of(tags);
}

VideoCamera camera_of_view(const VideoFacts& video, const ToldCamera& told,
                           std::vector<std::string>& assumptions) {
  VideoCamera camera;
  camera.config.intrinsics =
      CameraIntrinsics::from_field_of_view(video.width_px, video.height_px, *told.horizontal_fov_deg);
  if (told.is_on_gimbal) camera.config.mount = CameraMount::on_gimbal();
  camera.sigma_focal_percent = kViewSigma_percent;
  assumptions.push_back(fmt::format(
      "the camera is the one that the video tells, with a nominal field of view of {:.1f} deg, {}, "
      "its focal length an unknown of the calibration to {:g} % (--camera gives a better one)",
      *told.horizontal_fov_deg, told.is_on_gimbal ? "on a gimbal" : "looking straight down",
      kViewSigma_percent));
  return camera;
}

}  // namespace

VideoCamera video_camera(const std::string& camera_file, const VideoFacts& video, const ToldCamera& told,
                         std::vector<std::string>& assumptions) {
  if (told.focal_lengths.size() > 1)
    assumptions.emplace_back(
        "the camera zooms during the video: the calibration is taken to be that of the log's first focal "
        "length, and frames are located with the one that the log tells then");
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
    return {camera, 0.0};
  }
  if (told.horizontal_fov_deg) return camera_of_view(video, told, assumptions);
  const auto lens =
      told.focal_lengths.empty() ? std::nullopt : film_lens(video, told.focal_lengths.front().equivalent_mm);
  if (!lens)
    throw std::runtime_error(
        "the camera's focal length is not known: give its calibration with --camera (a file with width, "
        "height and horizontal_fov_deg will do: docs/formats.md, camera.json)");
  assumptions.push_back(
      fmt::format("the focal length is the log's equivalent for film of 35 mm, {:.0f} px to {:g} % where the "
                  "whole width of the sensor is used, an unknown of the calibration (--camera gives a better "
                  "one)",
                  lens->intrinsics.fx_px, kFilmSigma_percent));
  VideoCamera camera;
  camera.config.intrinsics = lens->intrinsics;
  camera.sigma_focal_percent = kFilmSigma_percent;
  return camera;
}

std::optional<Eigen::Vector2d> focal_px_at(const std::vector<io::LoggedFocalLength>& told,
                                           const CameraIntrinsics& camera, VehicleTime time) {
  const auto is_later = [](VehicleTime t, const io::LoggedFocalLength& focal) { return t < focal.time; };
  const auto next = std::upper_bound(told.begin(), told.end(), time, is_later);
  if (next == told.begin()) return std::nullopt;
  const double zoom = std::prev(next)->equivalent_mm / told.front().equivalent_mm;
  if (zoom == 1.0) return std::nullopt;
  return Eigen::Vector2d(zoom * camera.fx_px, zoom * camera.fy_px);
}

}  // namespace geoloc::apps
