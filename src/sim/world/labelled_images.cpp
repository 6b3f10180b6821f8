// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/world/labelled_images.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iomanip>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <stdexcept>

#include "appearance.hpp"
#include "geoloc/geometry/angles.hpp"
#include "ground.hpp"

namespace geoloc::sim {
namespace {

/// In the order of ObjectKind.
constexpr std::array<const char*, kDistractorKinds + 1> kKindNames{
    "target", "drain_cover", "tyre",    "white_panel",    "black_panel", "cross",
    "ring",   "disc",        "checker", "stone",          "road_line",   "bush",
    "wheel",  "manhole",     "arrow",   "quartered_disc", "bullseye"};

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

/// Share of the object's square that no later object hides.
double uncovered_fraction(const std::vector<PlacedObject>& objects, std::size_t index) {
  constexpr int kProbes = 24;  // along each side
  const PlacedObject& object = objects[index];
  const Eigen::Matrix2d enu_from_object = object_from_enu(object).transpose();
  int seen = 0;
  for (int row = 0; row < kProbes; ++row) {
    for (int column = 0; column < kProbes; ++column) {
      const Eigen::Vector2d unit((column + 0.5) / kProbes - 0.5, (row + 0.5) / kProbes - 0.5);
      const Eigen::Vector2d at = object.position_in_enu + enu_from_object * (object.size_m * unit);
      const auto hides = [&](const PlacedObject& other) {
        const Eigen::Vector2d in_other = object_from_enu(other) * (at - other.position_in_enu);
        return surface_at(other, in_other.cast<float>()).coverage > 0.5f;
      };
      const auto later = objects.begin() + static_cast<std::ptrdiff_t>(index) + 1;
      seen += std::any_of(later, objects.end(), hides) ? 0 : 1;
    }
  }
  return static_cast<double>(seen) / (kProbes * kProbes);
}

/// Angle between the line of sight to the object and the vertical.
double tilt_deg(const Shot& shot, const PlacedObject& object) {
  const Eigen::Vector3d at(object.position_in_enu.x(), object.position_in_enu.y(), 0.0);
  const Eigen::Vector3d sight = at - shot.enu_from_camera.translation;
  return std::acos(-sight.normalized().z()) / kRadPerDeg;
}

/// The outline's box, moved so that its middle is the image of the object's centre.
std::string yolo_lines(const Shot& shot) {
  std::ostringstream lines;
  lines << std::fixed << std::setprecision(6);
  const double width = shot.intrinsics.width_px, height = shot.intrinsics.height_px;
  for (const VisibleBox& label : labels_of(shot)) {
    lines << "0 " << (label.centre_px.x() + 0.5) / width << ' ' << (label.centre_px.y() + 0.5) / height << ' '
          << label.whole.width / width << ' ' << label.whole.height / height << '\n';
  }
  return lines.str();
}

/// Everything that is in the picture in part at least, a line each.
std::string object_lines(const Shot& shot, const std::string& picture) {
  std::ostringstream lines;
  lines << std::fixed << std::setprecision(3);
  const CameraModel camera(shot.intrinsics);
  const std::vector<PlacedObject>& objects = shot.scene.objects;
  for (std::size_t index = 0; index < objects.size(); ++index) {
    const auto box = visible_box(camera, shot.enu_from_camera, objects, index);
    if (!box) continue;
    lines << picture << ',' << kKindNames[static_cast<std::size_t>(objects[index].kind)] << ','
          << box->centre_px.x() + 0.5 << ',' << box->centre_px.y() + 0.5 << ',' << box->whole.width << ','
          << box->whole.height << ',' << box->visible_fraction * uncovered_fraction(objects, index) << ','
          << tilt_deg(shot, objects[index]) << '\n';
  }
  return lines.str();
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file);
  stream << text << std::flush;
  if (!stream) throw std::runtime_error(file.string() + ": cannot be written; is the disk full?");
}

void write_picture(const std::filesystem::path& file, const cv::Mat& picture,
                   const std::vector<int>& parameters = {}) {
  if (!cv::imwrite(file, picture, parameters))
    throw std::runtime_error(file.string() + ": cannot be written; is the disk full?");
}

void write_shot(const Shot& shot, Grounds& grounds, const std::filesystem::path& folder,
                const std::string& name, cv::Mat& picture) {
  CameraRenderer renderer(shot.intrinsics, shot.scene, grounds.get(shot.scene), shot.settings);
  renderer.render(shot.enu_from_camera, shot.blur_px, picture);
  write_picture(folder / "images" / (name + ".jpg"), picture, {cv::IMWRITE_JPEG_QUALITY, shot.jpeg_quality});
  write_text(folder / "labels" / (name + ".txt"), yolo_lines(shot));
}

/// As a camera sees it that stands still in clear air, is in focus, well exposed and free of noise.
void write_crisp(const Shot& shot, Grounds& grounds, const std::filesystem::path& file, cv::Mat& picture) {
  RenderSettings settings;
  settings.vignetting = 0.0;
  settings.focus_sigma_px = 0.0;
  settings.noise_sigma = 0.0;
  settings.visibility_m = 1e6;
  CameraRenderer renderer(shot.intrinsics, shot.scene, grounds.get(shot.scene), settings);
  renderer.render(shot.enu_from_camera, {0.0, 0.0}, picture);
  cv::Mat grey;
  cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
  write_picture(file, grey);
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

std::vector<VisibleBox> labels_of(const Shot& shot) {
  std::vector<VisibleBox> labels =
      visible_boxes(CameraModel(shot.intrinsics), shot.enu_from_camera, shot.scene.objects);
  const auto hardly_seen = [&](const VisibleBox& box) {
    return box.visible_fraction * uncovered_fraction(shot.scene.objects, box.object_index) <
           kLabelledFraction;
  };
  labels.erase(std::remove_if(labels.begin(), labels.end(), hardly_seen), labels.end());
  return labels;
}

bool write_labelled_images(const LabelledImages& wanted, const std::filesystem::path& folder,
                           const std::function<bool(int)>& progress) {
  namespace fs = std::filesystem;
  const fs::path target = folder.has_filename() ? folder : folder.parent_path();  // "pictures/" is "pictures"
  if (fs::exists(target)) throw std::runtime_error(target.string() + ": exists already; name a new folder");
  const Unfinished unfinished{target.string() + ".partial"};
  fs::remove_all(unfinished.folder);
  fs::create_directories(unfinished.folder / "images");
  fs::create_directories(unfinished.folder / "labels");
  if (wanted.with_crisp) fs::create_directories(unfinished.folder / "crisp");
  Grounds grounds;
  cv::Mat picture;
  std::string objects = "picture,kind,centre_x_px,centre_y_px,width_px,height_px,visible_fraction,tilt_deg\n";
  for (int index = 0; index < wanted.count; ++index) {
    std::ostringstream name;
    name << std::setw(5) << std::setfill('0') << index;
    const Shot shot = random_shot(wanted.seed, index, wanted.variety);
    write_shot(shot, grounds, unfinished.folder, name.str(), picture);
    if (wanted.with_crisp)
      write_crisp(shot, grounds, unfinished.folder / "crisp" / (name.str() + ".png"), picture);
    objects += object_lines(shot, name.str());
    if (!progress(index + 1)) return false;
  }
  write_text(unfinished.folder / "objects.csv", objects);
  fs::rename(unfinished.folder, target);
  return true;
}

}  // namespace geoloc::sim
