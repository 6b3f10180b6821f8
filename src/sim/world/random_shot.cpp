// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/attitude.hpp"
#include "geoloc/sim/random.hpp"
#include "geoloc/sim/world/labelled_images.hpp"
#include "ground_point.hpp"

namespace geoloc::sim {
namespace {

constexpr double kLeastSpacing_m = 1.0;      // between targets: two squares of 0.8 m hardly overlap
constexpr double kFarthestTarget_m = 110.0;  // a target is 8 px wide there

constexpr std::array kHeldBackStyles{GroundStyle::kPavingStones, GroundStyle::kCrackedMud,
                                     GroundStyle::kMeadow, GroundStyle::kRock};

GroundStyle random_ground(ImageSet set, Random& random) {
  if (set == ImageSet::kHeldBack)
    return kHeldBackStyles[static_cast<std::size_t>(random.index(static_cast<int>(kHeldBackStyles.size())))];
  return static_cast<GroundStyle>(random.index(static_cast<int>(kHeldBackStyles.front())));
}

/// The held-back light is darker, brighter, bluer or redder than any of the training's.
void draw_light(ImageSet set, RenderSettings& settings, Random& random) {
  if (set == ImageSet::kTraining) {
    settings.exposure = std::exp(random.uniform(std::log(0.5), std::log(1.5)));
    settings.warmth = random.uniform(-0.7, 0.7);
  } else {
    settings.exposure = random.chance(0.5) ? random.uniform(0.4, 0.5) : random.uniform(1.5, 1.75);
    settings.warmth = (random.chance(0.5) ? 1.0 : -1.0) * random.uniform(0.7, 1.0);
  }
}

RenderSettings random_settings(ImageSet set, Random& random) {
  RenderSettings settings;
  draw_light(set, settings, random);
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

Rigid3d random_pose(const ShotVariety& variety, Random& random) {
  const auto [least_m, greatest_m] = variety.range_m;
  const double range_m = std::exp(random.uniform(std::log(least_m), std::log(greatest_m)));
  const double tilt_rad = random.chance(0.25) ? 0.0 : kRadPerDeg * random.uniform(0.0, 60.0);
  const double tilt_towards_rad = random.uniform(-kPi, kPi);
  const double yaw_rad = random.uniform(-kPi, kPi);
  const Eigen::Quaterniond tilt(Eigen::AngleAxisd(
      tilt_rad, Eigen::Vector3d(std::cos(tilt_towards_rad), std::sin(tilt_towards_rad), 0.0)));
  const Eigen::Quaterniond ned_from_body = tilt * geoloc::ned_from_body({0.0, 0.0, yaw_rad});
  const Eigen::Vector3d position_in_enu(random.uniform(-500.0, 500.0), random.uniform(-500.0, 500.0),
                                        range_m * std::cos(tilt_rad));
  return Rigid3d{enu_from_ned() * ned_from_body, position_in_enu} * body_from_camera({});
}

/// Where the line of sight of a random pixel meets the ground.
std::optional<Eigen::Vector2d> random_place(const CameraModel& camera, const Rigid3d& enu_from_camera,
                                            Random& random) {
  const Eigen::Vector2d pixel(random.uniform(-20.0, 1300.0), random.uniform(-20.0, 740.0));
  const auto place = ground_point(camera, enu_from_camera, pixel);
  if (!place || (*place - enu_from_camera.translation).norm() > kFarthestTarget_m) return std::nullopt;
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

Eigen::Vector2d offset(double distance_m, Random& random) {
  const double towards_rad = random.uniform(-kPi, kPi);
  return distance_m * Eigen::Vector2d(std::cos(towards_rad), std::sin(towards_rad));
}

/// Stones, twigs of a bush, panels and lines that lie on some of the targets' edges.
std::vector<PlacedObject> random_occluders(const std::vector<PlacedObject>& targets, Random& random) {
  constexpr std::array kKinds{ObjectKind::kStone, ObjectKind::kBush, ObjectKind::kBlackPanel,
                              ObjectKind::kWhitePanel, ObjectKind::kDisc};
  std::vector<PlacedObject> occluders;
  for (const PlacedObject& target : targets) {
    if (!random.chance(0.15)) continue;
    PlacedObject occluder;
    occluder.kind = kKinds[static_cast<std::size_t>(random.index(static_cast<int>(kKinds.size())))];
    occluder.size_m = random.uniform(0.15, 0.5);
    occluder.position_in_enu = target.position_in_enu + offset(random.uniform(0.25, 0.6), random);
    occluder.heading_rad = random.uniform(-kPi, kPi);
    occluder.look = static_cast<std::uint32_t>(random.index(1 << 30));
    occluders.push_back(occluder);
  }
  return occluders;
}

/// Outline of a wall, a pole or the like.
std::vector<Eigen::Vector2d> bar_outline(const Eigen::Vector2d& middle, double height_m, Random& random) {
  const Eigen::Vector2d along = offset(random.uniform(0.1, 0.6) * height_m, random);
  const double half_width_m = 0.5 * std::exp(random.uniform(std::log(0.1), std::log(6.0)));
  const Eigen::Vector2d across = half_width_m * Eigen::Vector2d(-along.y(), along.x()).normalized();
  return {middle - along - across, middle - along + across, middle + along + across, middle + along - across};
}

/// Outline of a crown or a cloud.
std::vector<Eigen::Vector2d> blob_outline(const Eigen::Vector2d& middle, Random& random) {
  constexpr int kCorners = 24;
  const double radius_m = random.uniform(0.4, 4.0);
  std::vector<Eigen::Vector2d> outline;
  for (int i = 0; i < kCorners; ++i) {
    const double towards_rad = 2.0 * kPi * i / kCorners;
    const Eigen::Vector2d direction(std::cos(towards_rad), std::sin(towards_rad));
    outline.emplace_back(middle + radius_m * random.uniform(0.6, 1.2) * direction);
  }
  return outline;
}

std::vector<Shadow> random_shadows(const CameraModel& camera, const Rigid3d& enu_from_camera,
                                   Random& random) {
  std::vector<Shadow> shadows;
  const int count = random.chance(0.5) ? 0 : 1 + random.index(4);
  for (int i = 0; i < count; ++i) {
    const auto middle = random_place(camera, enu_from_camera, random);
    if (!middle) continue;
    Shadow shadow;
    shadow.outline_in_enu = random.chance(0.6) ? bar_outline(*middle, enu_from_camera.translation.z(), random)
                                               : blob_outline(*middle, random);
    shadow.darkness = random.uniform(0.25, 0.7);
    shadow.penumbra_px = random.uniform(0.5, 3.0);
    shadows.push_back(std::move(shadow));
  }
  return shadows;
}

/// Flying along shortens with the distance, turning does not.
Eigen::Vector2d random_blur(const CameraIntrinsics& intrinsics, double range_m, Random& random) {
  if (random.chance(0.4)) return Eigen::Vector2d::Zero();
  const double flying_px = random.uniform(0.0, 0.06) / range_m * intrinsics.fx_px;
  return offset(flying_px, random) + offset(random.uniform(0.0, 3.0), random);
}

}  // namespace

Shot random_shot(std::uint64_t seed, int index, const ShotVariety& variety) {
  Random random(seed * 1000003u + static_cast<std::uint64_t>(index));
  Shot shot;
  shot.scene.ground = random_ground(variety.set, random);
  shot.scene.ground_seed = static_cast<std::uint64_t>(random.index(kGroundsAStyle));
  shot.settings = random_settings(variety.set, random);
  shot.intrinsics = random_intrinsics(random);
  shot.enu_from_camera = random_pose(variety, random);
  const CameraModel camera(shot.intrinsics);
  const std::vector<PlacedObject> targets = random_targets(camera, shot.enu_from_camera, random);
  const Eigen::Vector2d middle =
      random_place(camera, shot.enu_from_camera, random).value_or(shot.enu_from_camera.translation.head<2>());
  const double reach_m = std::max(shot.enu_from_camera.translation.z(), 6.0);
  const Eigen::AlignedBox2d area(middle - Eigen::Vector2d::Constant(reach_m),
                                 middle + Eigen::Vector2d::Constant(reach_m));
  const auto distractor_seed = static_cast<std::uint64_t>(random.index(1 << 30));
  shot.scene.objects = make_distractors(random.index(30), area, targets, distractor_seed, kDistractorKinds);
  const std::vector<PlacedObject> occluders = random_occluders(targets, random);
  shot.scene.objects.insert(shot.scene.objects.end(), targets.begin(), targets.end());
  shot.scene.objects.insert(shot.scene.objects.end(), occluders.begin(), occluders.end());
  shot.scene.shadows = random_shadows(camera, shot.enu_from_camera, random);
  shot.blur_px = random_blur(shot.intrinsics, shot.enu_from_camera.translation.z(), random);
  shot.jpeg_quality = 60 + random.index(38);
  return shot;
}

}  // namespace geoloc::sim
