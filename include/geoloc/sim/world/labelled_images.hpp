// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "geoloc/camera/camera.hpp"
#include "geoloc/sim/world/camera_renderer.hpp"
#include "geoloc/sim/world/scene.hpp"
#include "geoloc/sim/world/visible_boxes.hpp"

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

/// Which grounds and which light: the held-back set shares neither with the training set.
enum class ImageSet { kTraining, kHeldBack };
inline constexpr int kGroundsAStyle = 2;  ///< how many seeds of each style are used

/// What shots are of.
struct ShotVariety {
  ImageSet set = ImageSet::kTraining;
  /// Least and greatest distance along the optical axis from the camera to the ground, between them
  /// log-uniform; so targets are 8-200 px wide.
  std::pair<double, double> range_m{4.5, 85.0};
};

/// Picture number `index` of a set: targets seen up to 60 deg from the vertical in varied light, up to eight
/// of them (none in one of ten) among distractors and shadows, some partly covered. Depends on nothing but
/// its arguments.
Shot random_shot(std::uint64_t seed, int index, const ShotVariety& variety = {});

/// The targets worth learning from: those of which at least kLabelledFraction is inside the image and
/// uncovered.
std::vector<VisibleBox> labels_of(const Shot& shot);
inline constexpr double kLabelledFraction = 0.4;

/// What to write.
struct LabelledImages {
  int count = 0;
  std::uint64_t seed = 1;
  ShotVariety variety{};
  /// Also folder/crisp/00000.png ...: the same in grey, by a camera that adds nothing.
  bool with_crisp = false;
};

/// Writes folder/images/00000.jpg ..., folder/labels/00000.txt ... (YOLO: class, centre and size relative to
/// the image, a line a target; the centre is the image of the target's centre, the size that of the box
/// around its whole outline) and folder/objects.csv (all objects in view: kind, centre, size of the
/// box, share that is seen, angle of the line of sight to the vertical). The folder must not exist; it
/// appears whole or not at all. progress(done) is called after each picture and ends the work by returning
/// false. Returns false where it was ended so; throws std::runtime_error where it cannot write.
bool write_labelled_images(const LabelledImages& wanted, const std::filesystem::path& folder,
                           const std::function<bool(int)>& progress);

}  // namespace geoloc::sim
