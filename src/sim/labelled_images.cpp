// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/labelled_images.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iomanip>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <stdexcept>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/attitude.hpp"
#include "geoloc/sim/random.hpp"
#include "ground.hpp"
#include "ground_point.hpp"

namespace geoloc::sim {
namespace {

constexpr int kGroundsAStyle = 2;
constexpr double kLeastSpacing_m = 1.0;  // between targets: two squares of 0.8 m hardly overlap

RenderSettings random_settings(Random& random) {
  RenderSettings settings;
  settings.exposure = random.uniform(0.6, 1.4);
  settings.warmth = random.uniform(-1.0, 1.0);
  settings.vignetting = random.uniform(0.0, 0.45);
  settings.focus_sigma_px = random.chance(0.2) ? random.uniform(1.0, 1.8) : random.uniform(0.3, 1.0);
  settings.noise_sigma = random.uniform(0.0, 9.0);
  settings.visibility_m = random.chance(0.2) ? random.uniform(100.0, 600.0) : 4000.0;
  settings.seed = static_cast<std::uint64_t>(random.index(1 << 30));
  return settings;
}

CameraIntrinsics random_intrinsics(Random& random) {
  CameraIntrinsics intrinsics = CameraIntrinsics::from_field_of_view(1280, 720, random.uniform(60.0, 80.0));
  intrinsics.distortion = {random.uniform(-0.2, 0.05), random.uniform(0.0, 0.05),
                           random.uniform(-0.001, 0.001), random.uniform(-0.001, 0.001), 0.0};
  return intrinsics;
}

/// Height log-uniform, which makes most targets 15 to 60 px wide.
Rigid3d random_pose(Random& random) {
  const double height_m = std::exp(random.uniform(std::log(8.0), std::log(60.0)));
  const double tilt_rad = random.chance(0.3) ? 0.0 : kRadPerDeg * random.uniform(0.0, 40.0);
  const double tilt_towards_rad = random.uniform(-kPi, kPi);
  const double yaw_rad = random.uniform(-kPi, kPi);
  const Eigen::Quaterniond tilt(Eigen::AngleAxisd(
      tilt_rad, Eigen::Vector3d(std::cos(tilt_towards_rad), std::sin(tilt_towards_rad), 0.0)));
  const Eigen::Quaterniond ned_from_body = tilt * geoloc::ned_from_body({0.0, 0.0, yaw_rad});
  const Rigid3d enu_from_body{enu_from_ned() * ned_from_body,
                              {random.uniform(-500.0, 500.0), random.uniform(-500.0, 500.0), height_m}};
  return enu_from_body * body_from_camera({});
}

/// Where the line of sight of a random pixel meets the ground.
std::optional<Eigen::Vector2d> random_place(const CameraModel& camera, const Rigid3d& enu_from_camera,
                                            Random& random) {
  const Eigen::Vector2d pixel(random.uniform(-20.0, 1300.0), random.uniform(-20.0, 740.0));
  const auto place = ground_point(camera, enu_from_camera, pixel);
  if (!place) return std::nullopt;
  return place->head<2>();
}

std::vector<PlacedObject> random_targets(const CameraModel& camera, const Rigid3d& enu_from_camera,
                                         Random& random) {
  const int count = random.chance(0.1) ? 0 : 1 + random.index(8);
  std::vector<PlacedObject> targets;
  for (int i = 0; i < count; ++i) {
    const auto place = random_place(camera, enu_from_camera, random);
    if (!place) continue;
    const auto too_near = [&](const PlacedObject& other) {
      return (other.position_in_enu - *place).norm() < kLeastSpacing_m;
    };
    if (std::any_of(targets.begin(), targets.end(), too_near)) continue;
    PlacedObject target;
    target.position_in_enu = *place;
    target.heading_rad = random.uniform(-kPi, kPi);
    target.look = static_cast<std::uint32_t>(random.index(1 << 30));
    targets.push_back(target);
  }
  return targets;
}

/// Each ground is made once, however many pictures show it.
class Grounds {
 public:
  std::shared_ptr<const Ground> get(const Scene& scene) {
    auto& ground = made_[static_cast<std::size_t>(scene.ground)][scene.ground_seed % kGroundsAStyle];
    if (!ground) ground = make_ground(scene.ground, scene.ground_seed);
    return ground;
  }

 private:
  std::array<std::array<std::shared_ptr<const Ground>, kGroundsAStyle>, kGroundStyleCount> made_;
};

std::string yolo_lines(const Shot& shot) {
  std::ostringstream lines;
  lines << std::fixed << std::setprecision(6);
  const double width = shot.intrinsics.width_px, height = shot.intrinsics.height_px;
  for (const VisibleBox& label : labels_of(shot)) {
    const Box& box = label.box;
    lines << "0 " << (box.x + 0.5 * box.width) / width << ' ' << (box.y + 0.5 * box.height) / height << ' '
          << box.width / width << ' ' << box.height / height << '\n';
  }
  return lines.str();
}

void write_shot(const Shot& shot, Grounds& grounds, const std::filesystem::path& folder,
                const std::string& name, cv::Mat& picture) {
  CameraRenderer renderer(shot.intrinsics, shot.scene.objects, grounds.get(shot.scene), shot.settings);
  renderer.render(shot.enu_from_camera, shot.blur_px, picture);
  const std::string image_file = folder / "images" / (name + ".jpg");
  if (!cv::imwrite(image_file, picture, {cv::IMWRITE_JPEG_QUALITY, shot.jpeg_quality})) {
    throw std::runtime_error(image_file + ": cannot be written; is the disk full?");
  }
  const std::string label_file = folder / "labels" / (name + ".txt");
  std::ofstream labels(label_file);
  labels << yolo_lines(shot) << std::flush;
  if (!labels) throw std::runtime_error(label_file + ": cannot be written; is the disk full?");
}

/// What is not renamed at the end, for whatever reason, is not left behind.
struct Unfinished {
  std::filesystem::path folder;

  ~Unfinished() {
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  }
};

}  // namespace

Shot random_shot(std::uint64_t seed, int index) {
  Random random(seed * 1000003u + static_cast<std::uint64_t>(index));
  Shot shot;
  shot.scene.ground = static_cast<GroundStyle>(random.index(kGroundStyleCount));
  shot.scene.ground_seed = static_cast<std::uint64_t>(random.index(kGroundsAStyle));
  shot.settings = random_settings(random);
  shot.intrinsics = random_intrinsics(random);
  shot.enu_from_camera = random_pose(random);
  const CameraModel camera(shot.intrinsics);
  shot.scene.objects = random_targets(camera, shot.enu_from_camera, random);
  const Eigen::Vector2d middle =
      random_place(camera, shot.enu_from_camera, random).value_or(shot.enu_from_camera.translation.head<2>());
  const double reach_m = shot.enu_from_camera.translation.z();
  const Eigen::AlignedBox2d area(middle - Eigen::Vector2d::Constant(reach_m),
                                 middle + Eigen::Vector2d::Constant(reach_m));
  const auto distractor_seed = static_cast<std::uint64_t>(random.index(1 << 30));
  const auto distractors = make_distractors(random.index(30), area, shot.scene.objects, distractor_seed);
  shot.scene.objects.insert(shot.scene.objects.begin(), distractors.begin(), distractors.end());
  const double blur_length_px = random.chance(0.5) ? random.uniform(0.0, 5.0) : 0.0;
  const double blur_towards_rad = random.uniform(-kPi, kPi);
  shot.blur_px = blur_length_px * Eigen::Vector2d(std::cos(blur_towards_rad), std::sin(blur_towards_rad));
  shot.jpeg_quality = 45 + random.index(50);
  return shot;
}

std::vector<VisibleBox> labels_of(const Shot& shot) {
  std::vector<VisibleBox> labels =
      visible_boxes(CameraModel(shot.intrinsics), shot.enu_from_camera, shot.scene.objects);
  const auto hardly_seen = [](const VisibleBox& box) { return box.visible_fraction < kLabelledFraction; };
  labels.erase(std::remove_if(labels.begin(), labels.end(), hardly_seen), labels.end());
  return labels;
}

bool write_labelled_images(int count, std::uint64_t seed, const std::filesystem::path& folder,
                           const std::function<bool(int)>& progress) {
  namespace fs = std::filesystem;
  const fs::path target = folder.has_filename() ? folder : folder.parent_path();  // "pictures/" is "pictures"
  if (fs::exists(target)) throw std::runtime_error(target.string() + ": exists already; name a new folder");
  const Unfinished unfinished{target.string() + ".partial"};
  fs::remove_all(unfinished.folder);
  fs::create_directories(unfinished.folder / "images");
  fs::create_directories(unfinished.folder / "labels");
  Grounds grounds;
  cv::Mat picture;
  for (int index = 0; index < count; ++index) {
    std::ostringstream name;
    name << std::setw(5) << std::setfill('0') << index;
    write_shot(random_shot(seed, index), grounds, unfinished.folder, name.str(), picture);
    if (!progress(index + 1)) return false;
  }
  fs::rename(unfinished.folder, target);
  return true;
}

}  // namespace geoloc::sim
