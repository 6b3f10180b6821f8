// SPDX-License-Identifier: Apache-2.0
// What OpenCV computed once: tools/fixtures/make_camera_fixtures.py says how.
#include <gtest/gtest.h>

#include <map>

#include "geoloc/camera/camera.hpp"
#include "support/number_lines.hpp"
#include "support/opencv_lens.hpp"
#include "support/source_tree.hpp"

namespace geoloc {
namespace {

struct Miss {
  int points = 0;
  double largest = 0.0;  ///< infinite where the camera gives no answer
};

void note(Miss& miss, double error) {
  ++miss.points;
  miss.largest = std::max(miss.largest, error);
}

template <typename Answer>
double distance(const Answer& answer, const Eigen::Vector2d& expected) {
  return answer ? (*answer - expected).norm() : std::numeric_limits<double>::infinity();
}

std::optional<Eigen::Vector2d> normalized_ray(const CameraModel& camera, const Eigen::Vector2d& pixel) {
  const auto ray = camera.ray(pixel);
  return ray ? std::optional(ray->normalized) : std::nullopt;
}

TEST(CameraAgainstOpenCvsNumbers, PixelsAndRaysAreThoseOfEachLens) {
  std::map<std::string, Miss> missed_pixels, missed_rays;
  std::optional<CameraModel> camera;
  std::string lens;
  for (const auto& [word, name, n] : read_number_lines(test_data() / "camera/points.txt")) {
    if (word == "lens") {
      camera.emplace(intrinsics_of({word, name, n}));
      lens = name;
    } else if (word == "projects") {
      note(missed_pixels[lens], distance(camera->pixel({n.at(0), n.at(1), n.at(2)}), {n.at(3), n.at(4)}));
    } else if (word == "undistorts") {
      note(missed_rays[lens], distance(normalized_ray(*camera, {n.at(0), n.at(1)}), {n.at(2), n.at(3)}));
    }
  }
  ASSERT_EQ(missed_pixels.size(), 4U);
  ASSERT_EQ(missed_rays.size(), 4U);
  for (const auto& [name, miss] : missed_pixels) {
    EXPECT_EQ(miss.points, 100) << name;
    EXPECT_LT(miss.largest, 1e-9) << name;
  }
  for (const auto& [name, miss] : missed_rays) {
    EXPECT_EQ(miss.points, 54) << name;
    EXPECT_LT(miss.largest, 1e-11) << name;
  }
}

}  // namespace
}  // namespace geoloc
