// SPDX-License-Identifier: Apache-2.0
#include "ground_grain.hpp"

#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "geoloc/geometry/angles.hpp"
#include "periodic_noise.hpp"

namespace geoloc::sim {
namespace {

constexpr int kShift = 4;  // fractional bits of the drawing functions' coordinates

struct Canvas {
  cv::Mat light;  // CV_32FC1, 1 = neutral
  double texel_m;
  cv::RNG& random;

  int size() const { return light.cols; }
  float uniform(double low, double high) { return static_cast<float>(random.uniform(low, high)); }
  float texels(double length_m) const { return static_cast<float>(length_m / texel_m); }
  int per_square_metre(double count) const {
    return static_cast<int>(count * std::pow(size() * texel_m, 2.0));
  }
  cv::Point2f anywhere() { return {uniform(0, size()), uniform(0, size())}; }
};

cv::Point fixed(cv::Point2f point) {
  return point * static_cast<float>(1 << kShift);
}

/// Blades and stalks: short strokes, lighter and darker.
void add_blades(Canvas& canvas, int count, double length_m, double contrast) {
  for (int i = 0; i < count; ++i) {
    const float angle = canvas.uniform(0, kPi);
    const float half = 0.5f * canvas.texels(length_m) * canvas.uniform(0.4, 1.2);
    const cv::Point2f along(half * std::cos(angle), half * std::sin(angle));
    const double shade = 1.0 + contrast * canvas.uniform(-1.0, 1.0);
    draw_periodic(canvas.size(), canvas.anywhere(), half, [&](cv::Point2f at) {
      cv::line(canvas.light, fixed(at - along), fixed(at + along), shade, 1, cv::LINE_8, kShift);
    });
  }
}

/// Stones with a shadow on one side.
void add_stones(Canvas& canvas, int count, double least_m, double most_m, double contrast) {
  for (int i = 0; i < count; ++i) {
    const double skewed = std::pow(canvas.uniform(0, 1), 3.0);  // many small, few large
    const float radius = 0.5f * canvas.texels(least_m + (most_m - least_m) * skewed);
    const cv::Size axes = fixed({radius, radius * canvas.uniform(0.6, 1.0)});
    const double turn_deg = canvas.uniform(0, 180);
    const double shade = 1.0 + contrast * canvas.uniform(-0.8, 1.0);
    const cv::Point2f away_from_sun = cv::Point2f(0.35f, 0.35f) * radius;
    draw_periodic(canvas.size(), canvas.anywhere(), 2.0f * radius, [&](cv::Point2f at) {
      cv::ellipse(canvas.light, fixed(at + away_from_sun), axes, turn_deg, 0, 360, 0.55, -1, cv::LINE_8,
                  kShift);
      cv::ellipse(canvas.light, fixed(at), axes, turn_deg, 0, 360, shade, -1, cv::LINE_8, kShift);
    });
  }
}

/// Dark lines that wander, as cracks in a pavement do.
void add_cracks(Canvas& canvas, int count, double length_m) {
  for (int i = 0; i < count; ++i) {
    cv::Point2f at = canvas.anywhere();
    float heading = canvas.uniform(0, 2 * kPi);
    const float step = canvas.texels(0.08);
    const int steps = static_cast<int>(length_m * canvas.uniform(0.3, 1.0) / 0.08);
    for (int k = 0; k < steps; ++k) {
      heading += canvas.uniform(-0.45, 0.45);
      const cv::Point2f next = at + step * cv::Point2f(std::cos(heading), std::sin(heading));
      const cv::Point2f move = next - at;
      draw_periodic(canvas.size(), at, 2.0f * step, [&](cv::Point2f from) {
        cv::line(canvas.light, fixed(from), fixed(from + move), 0.5, 1, cv::LINE_8, kShift);
      });
      at = next;
      at.x -= static_cast<float>(canvas.size()) * std::floor(at.x / static_cast<float>(canvas.size()));
      at.y -= static_cast<float>(canvas.size()) * std::floor(at.y / static_cast<float>(canvas.size()));
    }
  }
}

/// Slab joints, `slabs` of them along each side of the tile.
void add_joints(Canvas& canvas, int slabs) {
  const int pitch = canvas.size() / slabs;
  for (int i = 0; i < slabs; ++i) {
    canvas.light.colRange(i * pitch, i * pitch + 2).setTo(0.6);
    canvas.light.rowRange(i * pitch, i * pitch + 2).setTo(0.6);
  }
}

/// A wave along one axis, bent by noise: ripples in sand, rows of a field. Values in -1..1.
cv::Mat wave(Canvas& canvas, int waves, double bend) {
  const cv::Mat phase = fractal_noise(canvas.size(), 16, 64, 0.5, canvas.random);
  cv::Mat result(phase.size(), CV_32FC1);
  const double per_texel = 2.0 * kPi * waves / canvas.size();
  for (int row = 0; row < result.rows; ++row) {
    for (int column = 0; column < result.cols; ++column) {
      const double angle = per_texel * row + bend * static_cast<double>(phase.at<float>(row, column));
      result.at<float>(row, column) = static_cast<float>(std::sin(angle));
    }
  }
  return result;
}

/// Fractal roughness: contrast is its standard deviation, persistence near 1 stresses the finest grains.
void roughen(Canvas& canvas, double contrast, double persistence) {
  const cv::Mat noise = fractal_noise(canvas.size(), 32, canvas.size() / 2, persistence, canvas.random);
  cv::multiply(canvas.light, 1.0 + contrast * noise, canvas.light);
}

/// Three channels of the light, with a little colour noise; gain says how each channel follows `tint` in
/// -1..1.
cv::Mat coloured(Canvas& canvas, const cv::Mat& tint, const cv::Vec3d& gain, double hue_noise) {
  std::array<cv::Mat, 3> channels;
  for (int k = 0; k < 3; ++k) {
    const cv::Mat hue = periodic_noise(canvas.size(), 256, canvas.random);
    cv::Mat factor = 1.0 + hue_noise * hue;
    if (!tint.empty()) factor += gain[k] * tint;
    channels[static_cast<std::size_t>(k)] = canvas.light.mul(factor);
    channels[static_cast<std::size_t>(k)] /= cv::mean(channels[static_cast<std::size_t>(k)])[0];
  }
  cv::Mat merged;
  cv::merge(channels, merged);
  return merged;
}

cv::Mat grass(Canvas& canvas) {
  roughen(canvas, 0.25, 1.0);
  add_blades(canvas, canvas.per_square_metre(500), 0.10, 0.5);
  return coloured(canvas, {}, {}, 0.03);
}

cv::Mat dry_grass(Canvas& canvas) {
  roughen(canvas, 0.2, 1.0);
  add_blades(canvas, canvas.per_square_metre(400), 0.14, 0.4);
  add_stones(canvas, canvas.per_square_metre(2), 0.02, 0.08, 0.3);
  return coloured(canvas, {}, {}, 0.03);
}

cv::Mat soil(Canvas& canvas) {
  roughen(canvas, 0.17, 1.0);
  add_stones(canvas, canvas.per_square_metre(25), 0.015, 0.10, 0.35);
  return coloured(canvas, {}, {}, 0.01);
}

cv::Mat sand(Canvas& canvas) {
  roughen(canvas, 0.06, 1.0);
  add_stones(canvas, canvas.per_square_metre(0.5), 0.02, 0.08, 0.3);
  return coloured(canvas, wave(canvas, 128, 2.5), {0.05, 0.045, 0.04}, 0.005);
}

cv::Mat gravel(Canvas& canvas) {
  add_stones(canvas, canvas.per_square_metre(420), 0.02, 0.08, 0.4);
  roughen(canvas, 0.08, 1.0);
  return coloured(canvas, {}, {}, 0.02);
}

cv::Mat asphalt(Canvas& canvas) {
  roughen(canvas, 0.13, 1.2);
  add_cracks(canvas, canvas.per_square_metre(0.05), 6.0);
  return coloured(canvas, {}, {}, 0.005);
}

cv::Mat concrete(Canvas& canvas) {
  roughen(canvas, 0.06, 1.0);
  add_joints(canvas, 8);
  add_cracks(canvas, canvas.per_square_metre(0.02), 2.5);
  return coloured(canvas, {}, {}, 0.005);
}

cv::Mat field(Canvas& canvas) {
  roughen(canvas, 0.22, 1.0);
  add_blades(canvas, canvas.per_square_metre(250), 0.15, 0.45);
  add_stones(canvas, canvas.per_square_metre(6), 0.02, 0.08, 0.3);
  return coloured(canvas, wave(canvas, 32, 0.35), {-0.10, -0.02, -0.16}, 0.03);
}

cv::Mat snow(Canvas& canvas) {
  roughen(canvas, 0.03, 0.8);
  add_stones(canvas, canvas.per_square_metre(0.3), 0.02, 0.15, 0.2);
  return coloured(canvas, wave(canvas, 32, 3.0), {0.02, 0.03, 0.035}, 0.003);
}

/// Wavelets that glitter.
cv::Mat water(Canvas& canvas) {
  const cv::Mat ripples = wave(canvas, 64, 4.0), swell = wave(canvas, 16, 2.0).t();
  cv::multiply(canvas.light, 1.0 + 0.14 * ripples + 0.1 * swell, canvas.light);
  roughen(canvas, 0.06, 0.9);
  add_blades(canvas, canvas.per_square_metre(3), 0.10, 0.9);
  return coloured(canvas, ripples.mul(swell), {0.06, 0.05, 0.03}, 0.01);
}

/// Rows 0.75 m apart.
cv::Mat crops(Canvas& canvas) {
  const cv::Mat rows = wave(canvas, 32, 0.2);
  cv::multiply(canvas.light, 1.0 + 0.25 * rows, canvas.light);
  roughen(canvas, 0.2, 1.0);
  add_blades(canvas, canvas.per_square_metre(350), 0.18, 0.5);
  return coloured(canvas, rows, {-0.12, 0.06, -0.14}, 0.03);
}

/// Leaves and twigs.
cv::Mat forest_floor(Canvas& canvas) {
  roughen(canvas, 0.22, 1.0);
  add_stones(canvas, canvas.per_square_metre(160), 0.03, 0.10, 0.6);
  add_blades(canvas, canvas.per_square_metre(20), 0.6, 0.6);
  return coloured(canvas, {}, {}, 0.08);
}

/// Setts in courses, each of a shade of its own, every other course shifted by half a sett.
cv::Mat paving_stones(Canvas& canvas) {
  constexpr int kCourses = 128, kJoint = 2;
  const int pitch = canvas.size() / kCourses, length = 2 * pitch;
  for (int course = 0; course < kCourses; ++course) {
    for (int left = 0; left < canvas.size(); left += length) {
      const double shade = canvas.uniform(0.8, 1.2);
      const int shifted = (left + course % 2 * pitch) % canvas.size();
      for (int half = 0; half < 2; ++half) {
        const cv::Rect part((shifted + half * pitch) % canvas.size(), course * pitch, pitch, pitch);
        canvas.light(part).setTo(shade);
        if (half == 0) canvas.light(cv::Rect(part.x, part.y, kJoint, pitch)).setTo(0.55);
        canvas.light(cv::Rect(part.x, part.y, pitch, kJoint)).setTo(0.55);
      }
    }
  }
  roughen(canvas, 0.07, 1.0);
  return coloured(canvas, {}, {}, 0.02);
}

cv::Mat cracked_mud(Canvas& canvas) {
  roughen(canvas, 0.05, 0.9);
  add_cracks(canvas, canvas.per_square_metre(4), 1.5);
  add_cracks(canvas, canvas.per_square_metre(0.3), 8.0);
  return coloured(canvas, {}, {}, 0.01);
}

/// High grass with flowers.
cv::Mat meadow(Canvas& canvas) {
  roughen(canvas, 0.28, 0.9);
  add_blades(canvas, canvas.per_square_metre(250), 0.25, 0.6);
  cv::Mat flowers(canvas.light.size(), CV_32FC1, cv::Scalar(0.0));
  for (int i = 0; i < canvas.per_square_metre(12); ++i) {
    cv::circle(flowers, fixed(canvas.anywhere()), 2 << kShift, 1.0, -1, cv::LINE_8, kShift);
  }
  return coloured(canvas, flowers, {0.3, 0.9, 1.4}, 0.05);
}

/// Layers and clefts.
cv::Mat rock(Canvas& canvas) {
  const cv::Mat layers = wave(canvas, 16, 6.0);
  cv::multiply(canvas.light, 1.0 + 0.18 * layers, canvas.light);
  roughen(canvas, 0.16, 0.85);
  add_cracks(canvas, canvas.per_square_metre(0.8), 5.0);
  add_stones(canvas, canvas.per_square_metre(6), 0.05, 0.4, 0.4);
  return coloured(canvas, layers, {-0.03, 0.0, 0.03}, 0.01);
}

}  // namespace

cv::Mat ground_grain(GroundStyle style, int size, double texel_m, cv::RNG& random) {
  Canvas canvas{cv::Mat(size, size, CV_32FC1, cv::Scalar(1.0)), texel_m, random};
  switch (style) {
    case GroundStyle::kGrass:
      return grass(canvas);
    case GroundStyle::kDryGrass:
      return dry_grass(canvas);
    case GroundStyle::kSoil:
      return soil(canvas);
    case GroundStyle::kSand:
      return sand(canvas);
    case GroundStyle::kGravel:
      return gravel(canvas);
    case GroundStyle::kAsphalt:
      return asphalt(canvas);
    case GroundStyle::kConcrete:
      return concrete(canvas);
    case GroundStyle::kField:
      return field(canvas);
    case GroundStyle::kSnow:
      return snow(canvas);
    case GroundStyle::kWater:
      return water(canvas);
    case GroundStyle::kCrops:
      return crops(canvas);
    case GroundStyle::kForestFloor:
      return forest_floor(canvas);
    case GroundStyle::kPavingStones:
      return paving_stones(canvas);
    case GroundStyle::kCrackedMud:
      return cracked_mud(canvas);
    case GroundStyle::kMeadow:
      return meadow(canvas);
    case GroundStyle::kRock:
      return rock(canvas);
  }
  return coloured(canvas, {}, {}, 0.0);
}

}  // namespace geoloc::sim
