// SPDX-License-Identifier: Apache-2.0
#include "appearance.hpp"

#include <algorithm>
#include <cmath>

#include "geoloc/geometry/angles.hpp"
#include "value_noise.hpp"

namespace geoloc::sim {
namespace {

const Surface kNothing{{0.0f, 0.0f, 0.0f}, 0.0f};
constexpr float kLineWidth_m = 0.15f;  // of a painted line, as on roads

// Every look_of_… takes a point in units of the object's size (a square reaches from -0.5 to 0.5).
using Point = Eigen::Vector2f;

/// A number in [0, 1) that belongs to the object; `which` tells its uses apart.
float trait(const PlacedObject& object, std::uint32_t which) {
  return hashed_unit(object.look, which);
}

Surface painted(float grey) {
  return {{grey * 0.98f, grey, grey}, 1.0f};
}

bool in_square(const Point& at) {
  return at.cwiseAbs().maxCoeff() < 0.5f;
}

/// White square; black disc with a bow tie of two white quadrants and a black dot: no rotation below 180 deg
/// looks the same, and the centre of the outline is the centre of the target.
Surface look_of_fiducial(const PlacedObject& object, const Point& at) {
  if (!in_square(at)) return kNothing;
  const float radius = at.norm();
  const bool white = radius > 0.45f || (radius < 0.34f && radius > 0.085f && at.x() * at.y() > 0.0f);
  const float paper = 0.84f + 0.12f * trait(object, 2);
  const float ink = 0.05f + 0.07f * trait(object, 3);
  return painted((white ? paper : ink));
}

Surface look_of_drain_cover(const PlacedObject& object, const Point& at) {
  const float radius = at.norm();
  if (radius > 0.5f) return kNothing;
  const bool groove = std::abs(radius - 0.43f) < 0.02f;
  const bool hatched = radius < 0.38f && (std::sin(38.0f * at.x()) * std::sin(38.0f * at.y()) > 0.15f);
  const float iron = 0.22f + 0.2f * trait(object, 2);
  Surface surface = painted(iron * (groove ? 0.35f : hatched ? 0.7f : 1.0f));
  surface.reflectance *= Eigen::Array3f(0.9f, 0.97f, 1.05f);  // a trace of rust
  return surface;
}

Surface look_of_tyre(const Point& at) {
  const float radius = at.norm();
  if (radius > 0.5f || radius < 0.27f) return kNothing;
  const float lit =
      0.5f + 0.5f * std::cos((radius - 0.37f) * 18.0f);  // the round of the rubber catches light
  const float tread = radius > 0.44f && std::sin(std::atan2(at.y(), at.x()) * 40.0f) > 0.4f ? 0.6f : 1.0f;
  return painted((0.08f + 0.14f * lit) * tread);
}

Surface look_of_panel(const Point& at, float grey) {
  if (!in_square(at)) return kNothing;
  return painted(grey);
}

Surface look_of_cross(const PlacedObject& object, const Point& at) {
  const float half_arm = 0.07f + 0.06f * trait(object, 2);
  if (!in_square(at) || at.cwiseAbs().minCoeff() > half_arm) return kNothing;
  return painted(0.9f);
}

Surface look_of_ring(const PlacedObject& object, const Point& at) {
  const float width = 0.06f + 0.1f * trait(object, 2);
  const float radius = at.norm();
  if (radius > 0.5f || radius < 0.5f - width) return kNothing;
  return painted((trait(object, 3) < 0.7f ? 0.9f : 0.1f));
}

Surface look_of_disc(const PlacedObject& object, const Point& at) {
  if (at.norm() > 0.5f) return kNothing;
  const float shade = trait(object, 2);
  Surface surface = painted((shade < 0.4f ? 0.92f : shade < 0.7f ? 0.08f : 0.6f));
  if (shade >= 0.7f)
    surface.reflectance *= Eigen::Array3f(trait(object, 4), trait(object, 5), trait(object, 6));
  return surface;
}

Surface look_of_checker(const PlacedObject& object, const Point& at) {
  if (!in_square(at)) return kNothing;
  const float squares = 2.0f + std::floor(3.0f * trait(object, 2));
  const int parity =
      static_cast<int>((at.x() + 0.5f) * squares) + static_cast<int>((at.y() + 0.5f) * squares);
  return painted((parity % 2 == 0 ? 0.9f : 0.08f));
}

/// Radius of an irregular outline in the direction of the point.
float ragged_radius(const PlacedObject& object, const Point& at, float raggedness) {
  const float angle = std::atan2(at.y(), at.x());
  const float bump = value_noise(2.0f * std::cos(angle) + 7.0f, 2.0f * std::sin(angle) + 7.0f, object.look);
  return 0.5f * (1.0f - raggedness * bump);
}

Surface look_of_stone(const PlacedObject& object, const Point& at) {
  if (at.norm() > ragged_radius(object, at, 0.45f)) return kNothing;
  const float facet = value_noise(5.0f * at.x() + 3.0f, 5.0f * at.y(), object.look + 1u);
  const float relief = 0.75f + 0.4f * facet + 0.35f * (at.x() - at.y());  // the sun from one side
  Surface surface = painted((0.4f + 0.3f * trait(object, 2)) * relief);
  surface.reflectance *= Eigen::Array3f(0.88f, 0.96f, 1.0f);
  return surface;
}

Surface look_of_road_line(const PlacedObject& object, const Eigen::Vector2f& point_m) {
  const Eigen::Vector2f half = half_extent_m(object);
  if (std::abs(point_m.x()) > half.x() || std::abs(point_m.y()) > half.y()) return kNothing;
  Surface surface = painted(0.88f);
  if (trait(object, 2) < 0.3f) surface.reflectance *= Eigen::Array3f(0.35f, 0.82f, 1.0f);  // yellow
  const float rubbed = value_noise(9.0f * point_m.x(), 25.0f * point_m.y(), object.look);
  surface.coverage = std::clamp(1.6f - 1.3f * rubbed * (0.4f + trait(object, 3)), 0.0f, 1.0f);
  return surface;
}

Surface look_of_bush(const PlacedObject& object, const Point& at) {
  const float radius = at.norm();
  const float leafy = 0.7f + 0.3f * value_noise(14.0f * at.x(), 14.0f * at.y(), 9u);
  const float edge = ragged_radius(object, at, 0.4f) * leafy;
  if (radius > edge) return kNothing;
  const float leaves = value_noise(22.0f * at.x(), 22.0f * at.y(), object.look);
  const float clumps = value_noise(6.0f * at.x(), 6.0f * at.y(), object.look + 2u);
  const float light = 0.35f + 0.55f * leaves * clumps + 0.35f * (at.x() - at.y());
  const float dryness = trait(object, 2);
  const Eigen::Array3f leaf(0.16f, 0.42f + 0.1f * dryness, 0.22f + 0.25f * dryness);
  return {(leaf * std::max(light, 0.12f) * 1.3f).min(1.0f), 1.0f};
}

/// A tyre on a bright rim with spokes.
Surface look_of_wheel(const PlacedObject& object, const Point& at) {
  const float radius = at.norm();
  if (radius > 0.5f) return kNothing;
  if (radius > 0.34f) return painted(0.1f + 0.06f * trait(object, 3));
  const float spokes = 3.0f + std::floor(4.0f * trait(object, 2));
  const bool open = radius > 0.09f && radius < 0.29f && std::cos(spokes * std::atan2(at.y(), at.x())) > 0.2f;
  return painted((open ? 0.12f : 0.5f + 0.4f * trait(object, 4)));
}

/// Cast iron: rings of slots in a bright or rusty frame.
Surface look_of_manhole(const PlacedObject& object, const Point& at) {
  const float radius = at.norm();
  if (radius > 0.5f) return kNothing;
  const float slots = 8.0f + 4.0f * std::floor(4.0f * trait(object, 2));
  const bool frame = radius > 0.42f;
  const bool slot = std::sin(40.0f * radius) > 0.1f && std::sin(slots * std::atan2(at.y(), at.x())) > -0.3f;
  const float iron = 0.25f + 0.2f * trait(object, 3);
  Surface surface = painted(frame ? 0.3f + 0.4f * trait(object, 4) : slot ? 0.4f * iron : iron);
  surface.reflectance *= Eigen::Array3f(0.92f, 0.97f, 1.04f);
  return surface;
}

/// As on a road: a shaft and a head.
Surface look_of_arrow(const PlacedObject& object, const Point& at) {
  const bool shaft = at.x() > -0.5f && at.x() < 0.1f && std::abs(at.y()) < 0.05f + 0.05f * trait(object, 2);
  const bool head = at.x() >= 0.1f && at.x() < 0.5f && std::abs(at.y()) < 0.6f * (0.5f - at.x());
  if (!shaft && !head) return kNothing;
  return painted(0.9f);
}

/// As on crash-test dummies: no square around it and no dot in it.
Surface look_of_quartered_disc(const PlacedObject& object, const Point& at) {
  const float radius = at.norm();
  if (radius > 0.5f) return kNothing;
  const bool rim = radius > 0.5f - 0.08f * trait(object, 2);
  const Eigen::Array3f dark =
      trait(object, 3) < 0.6f ? Eigen::Array3f(0.08f, 0.08f, 0.08f) : Eigen::Array3f(0.1f, 0.75f, 0.85f);
  if (rim || at.x() * at.y() < 0.0f) return {dark, 1.0f};
  return painted(0.9f);
}

/// Rings about a disc, on a square panel or not.
Surface look_of_bullseye(const PlacedObject& object, const Point& at) {
  if (!in_square(at)) return kNothing;
  const float radius = at.norm();
  const bool on_panel = trait(object, 2) < 0.6f;
  if (radius > 0.45f) return on_panel ? painted(0.9f) : kNothing;
  const float rings = 1.0f + std::floor(3.0f * trait(object, 3));
  const bool dark = static_cast<int>(radius / 0.45f * rings * 2.0f) % 2 == (on_panel ? 1 : 0);
  return painted(dark ? 0.08f : 0.9f);
}

}  // namespace

Eigen::Vector2f half_extent_m(const PlacedObject& object) {
  const auto half = static_cast<float>(0.5 * object.size_m);
  if (object.kind == ObjectKind::kRoadLine) return {half, 0.5f * kLineWidth_m};
  return {half, half};
}

Surface surface_at(const PlacedObject& object, const Eigen::Vector2f& point_in_object_m) {
  const Point at = point_in_object_m / static_cast<float>(object.size_m);
  switch (object.kind) {
    case ObjectKind::kFiducial:
      return look_of_fiducial(object, at);
    case ObjectKind::kDrainCover:
      return look_of_drain_cover(object, at);
    case ObjectKind::kTyre:
      return look_of_tyre(at);
    case ObjectKind::kWhitePanel:
      return look_of_panel(at, 0.92f);
    case ObjectKind::kBlackPanel:
      return look_of_panel(at, 0.09f);
    case ObjectKind::kCross:
      return look_of_cross(object, at);
    case ObjectKind::kRing:
      return look_of_ring(object, at);
    case ObjectKind::kDisc:
      return look_of_disc(object, at);
    case ObjectKind::kChecker:
      return look_of_checker(object, at);
    case ObjectKind::kStone:
      return look_of_stone(object, at);
    case ObjectKind::kRoadLine:
      return look_of_road_line(object, point_in_object_m);
    case ObjectKind::kBush:
      return look_of_bush(object, at);
    case ObjectKind::kWheel:
      return look_of_wheel(object, at);
    case ObjectKind::kManhole:
      return look_of_manhole(object, at);
    case ObjectKind::kArrow:
      return look_of_arrow(object, at);
    case ObjectKind::kQuarteredDisc:
      return look_of_quartered_disc(object, at);
    case ObjectKind::kBullseye:
      return look_of_bullseye(object, at);
  }
  return kNothing;
}

float wear_at(const PlacedObject& object, const Eigen::Vector2f& point_in_object_m) {
  constexpr float kBlotchesAcross = 6.0f;
  const Eigen::Vector2f blotch = point_in_object_m * (kBlotchesAcross / static_cast<float>(object.size_m));
  return 1.0f - 0.16f * value_noise(blotch.x(), blotch.y(), object.look) * trait(object, 1);
}

Eigen::Matrix2d object_from_enu(const PlacedObject& object) {
  const double sine = std::sin(object.heading_rad), cosine = std::cos(object.heading_rad);
  Eigen::Matrix2d rotation;
  rotation << sine, cosine,  // forward
      cosine, -sine;         // right
  return rotation;
}

}  // namespace geoloc::sim
