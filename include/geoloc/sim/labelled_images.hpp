// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>
#include <vector>

#include "geoloc/camera/camera.hpp"
#include "geoloc/sim/camera_renderer.hpp"
#include "geoloc/sim/scene.hpp"
#include "geoloc/sim/visible_boxes.hpp"

namespace geoloc::sim {

/// Everything about one picture but its pixels.
struct Shot {
  Scene scene;
  RenderSettings settings;
  CameraIntrinsics intrinsics;  ///< 1280 x 720
  Rigid3d enu_from_camera;
  Eigen::Vector2d blur_px;
  int jpeg_quality;
};

/// Picture number `index` of a set: 8-60 m above any ground, tilted up to 40 deg, in any light, with up to
/// eight targets (none in one of ten) and distractors. Depends on nothing but its arguments.
Shot random_shot(std::uint64_t seed, int index);

/// The targets worth learning from: those of which at least kLabelledFraction is inside the image.
std::vector<VisibleBox> labels_of(const Shot& shot);
inline constexpr double kLabelledFraction = 0.4;

/// Writes folder/images/00000.jpg ... and folder/labels/00000.txt ... (YOLO: class, centre and size relative
/// to the image, a line a target). The folder must not exist; it appears whole or not at all. progress(done)
/// is called after each picture and ends the work by returning false. Returns false where it was ended so;
/// throws std::runtime_error where it cannot write.
bool write_labelled_images(int count, std::uint64_t seed, const std::filesystem::path& folder,
                           const std::function<bool(int)>& progress);

}  // namespace geoloc::sim
