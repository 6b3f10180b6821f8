// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

namespace geoloc::sim {

/// The fiducial target, and things on the ground that a careless detector takes for one.
enum class ObjectKind {
  kFiducial,
  kDrainCover,
  kTyre,
  kWhitePanel,
  kBlackPanel,
  kCross,
  kRing,
  kDisc,
  kChecker,
  kStone,
  kRoadLine,
  kBush,
  kWheel,
  kManhole,
  kArrow,
  kQuarteredDisc,
  kBullseye,
};

inline constexpr double kFiducialSize_m = 0.8;  ///< side of the target's white square

/// A flat object on the ground plane.
struct PlacedObject {
  ObjectKind kind = ObjectKind::kFiducial;
  Eigen::Vector2d position_in_enu = Eigen::Vector2d::Zero();  ///< of its centre, east, north [m]
  double heading_rad = 0.0;                                   ///< of its forward axis, clockwise from north
  double size_m = kFiducialSize_m;                            ///< side or diameter; the length of a road line
  std::uint32_t look = 0;                                     ///< seed of its wear, colour and variant
};

enum class GroundStyle {
  kGrass,
  kDryGrass,
  kSoil,
  kSand,
  kGravel,
  kAsphalt,
  kConcrete,
  kField,
  kSnow,
  kWater,
  kCrops,
  kForestFloor,
  kPavingStones,
  kCrackedMud,
  kMeadow,
  kRock,
};
inline constexpr int kGroundStyleCount = 16;
inline constexpr int kFlightGroundStyleCount = 8;  ///< the first of them: what flights are flown over

/// A shadow on the ground and on all that lies there.
struct Shadow {
  std::vector<Eigen::Vector2d> outline_in_enu;  ///< polygon, east, north [m]
  double darkness = 0.5;                        ///< fraction of the light that it takes
  double penumbra_px = 1.0;                     ///< standard deviation of its blurred edge
};

/// What a camera can see: objects on the plane z = 0 of the local east-north-up frame, painted in this order.
struct Scene {
  std::vector<PlacedObject> objects;
  GroundStyle ground = GroundStyle::kGrass;
  std::uint64_t ground_seed = 1;
  std::vector<Shadow> shadows;
};

/// How many kinds of distractors there are: the first, which flights know, and all.
inline constexpr int kFlightDistractorKinds = 11;
inline constexpr int kDistractorKinds = 16;

/// Distractors of the first `kinds` kinds at random places of the area; none overlaps another or anything of
/// keep_clear_of. Fewer than count where the area is too full.
std::vector<PlacedObject> make_distractors(int count, const Eigen::AlignedBox2d& area_in_enu,
                                           const std::vector<PlacedObject>& keep_clear_of, std::uint64_t seed,
                                           int kinds = kFlightDistractorKinds);

}  // namespace geoloc::sim
