// SPDX-License-Identifier: Apache-2.0
#include "ground.hpp"

#include <array>

#include "ground_grain.hpp"
#include "periodic_noise.hpp"

namespace geoloc::sim {
namespace {

constexpr int kPatchesSize = 1024;
constexpr double kPatchTexel_m = 0.15;
constexpr int kGrainSize = 2048;
constexpr double kGrainTexel_m = 0.012;

/// Blue, green, red: the usual colour, and the two it turns to in patches.
struct Palette {
  cv::Vec3f usual;
  cv::Vec3f patch;
  cv::Vec3f spot;
  float mottling;  // fractional change of light within a patch
};

Palette palette_of(GroundStyle style) {
  switch (style) {
    case GroundStyle::kGrass:
      return {{58, 104, 86}, {72, 124, 118}, {84, 112, 128}, 0.10f};
    case GroundStyle::kDryGrass:
      return {{96, 142, 156}, {84, 126, 128}, {88, 112, 130}, 0.10f};
    case GroundStyle::kSoil:
      return {{72, 96, 124}, {60, 80, 104}, {92, 118, 146}, 0.08f};
    case GroundStyle::kSand:
      return {{150, 184, 204}, {134, 168, 190}, {166, 196, 212}, 0.05f};
    case GroundStyle::kGravel:
      return {{136, 144, 150}, {118, 126, 132}, {146, 156, 164}, 0.06f};
    case GroundStyle::kAsphalt:
      return {{94, 92, 92}, {84, 82, 81}, {104, 103, 102}, 0.03f};
    case GroundStyle::kConcrete:
      return {{158, 166, 168}, {146, 152, 154}, {168, 175, 178}, 0.05f};
    case GroundStyle::kField:
      return {{62, 92, 98}, {56, 100, 84}, {76, 106, 128}, 0.08f};
    case GroundStyle::kSnow:
      return {{214, 206, 200}, {226, 220, 216}, {176, 172, 170}, 0.04f};
    case GroundStyle::kWater:
      return {{104, 92, 68}, {84, 76, 52}, {128, 122, 102}, 0.06f};
    case GroundStyle::kCrops:
      return {{70, 134, 104}, {84, 160, 150}, {66, 92, 110}, 0.08f};
    case GroundStyle::kForestFloor:
      return {{52, 74, 96}, {44, 82, 62}, {60, 96, 140}, 0.12f};
    case GroundStyle::kPavingStones:
      return {{122, 124, 130}, {104, 110, 126}, {132, 132, 134}, 0.04f};
    case GroundStyle::kCrackedMud:
      return {{128, 146, 160}, {112, 132, 148}, {142, 160, 172}, 0.05f};
    case GroundStyle::kMeadow:
      return {{66, 126, 96}, {76, 148, 140}, {92, 140, 112}, 0.10f};
    case GroundStyle::kRock:
      return {{112, 114, 120}, {84, 90, 96}, {136, 142, 150}, 0.12f};
  }
  return {{128, 128, 128}, {128, 128, 128}, {128, 128, 128}, 0.0f};
}

/// 0 below, 1 above, smooth between.
float step(float low, float high, float value) {
  const float t = std::min(std::max((value - low) / (high - low), 0.0f), 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

cv::Mat ground_patches(GroundStyle style, cv::RNG& random) {
  const Palette palette = palette_of(style);
  const cv::Mat where_patch = fractal_noise(kPatchesSize, 8, 512, 0.55, random);
  const cv::Mat where_spot = fractal_noise(kPatchesSize, 16, 512, 0.6, random);
  const cv::Mat mottle = fractal_noise(kPatchesSize, 4, 512, 0.85, random);
  cv::Mat colours(kPatchesSize, kPatchesSize, CV_8UC3);
  for (int row = 0; row < colours.rows; ++row) {
    for (int column = 0; column < colours.cols; ++column) {
      const float patch = step(-0.6f, 1.2f, where_patch.at<float>(row, column));
      const float spot = step(0.9f, 1.8f, where_spot.at<float>(row, column));
      cv::Vec3f colour = palette.usual * (1.0f - patch) + palette.patch * patch;
      colour = colour * (1.0f - spot) + palette.spot * spot;
      colours.at<cv::Vec3b>(row, column) = colour * (1.0f + palette.mottling * mottle.at<float>(row, column));
    }
  }
  return colours;
}

}  // namespace

std::shared_ptr<const Ground> make_ground(GroundStyle style, std::uint64_t seed) {
  cv::RNG random(seed * 0x9E3779B97F4A7C15u + static_cast<std::uint64_t>(style) + 1u);
  MipAtlas patches(ground_patches(style, random), kPatchTexel_m);
  cv::Mat grain;
  ground_grain(style, kGrainSize, kGrainTexel_m, random).convertTo(grain, CV_8UC3, kGrainUnity);
  return std::make_shared<const Ground>(Ground{std::move(patches), MipAtlas(grain, kGrainTexel_m)});
}

}  // namespace geoloc::sim
