// SPDX-License-Identifier: Apache-2.0
// What docs/library.md says of memory.
#include <gtest/gtest.h>
#include <malloc.h>

#include <fstream>
#include <memory>
#include <sstream>
#include <string>

#include "geoloc/pipeline/geolocator.hpp"
#include "support/source_tree.hpp"

#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 33)

namespace geoloc {
namespace {

/// What a Geolocator holds from construction on [MB]. Eigen's matrices are not made by operator
/// new, so that only the heap itself can tell.
double heap_mb(Method method, int max_tracks, int max_detections) {
  GeolocatorConfig config;
  config.method = method;
  config.max_detections = max_detections;
  config.joint.max_tracks = config.paper.max_tracks = max_tracks;
  const auto in_use = [] {
    const struct mallinfo2 heap = mallinfo2();
    return static_cast<double>(heap.uordblks + heap.hblkhd);
  };
  const double before = in_use();
  const auto geolocator = std::make_unique<Geolocator>(config);
  return 1e-6 * (in_use() - before);
}

class Memory : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!(heap_mb(Method::kJoint, 1000, 256) > 1.0)) GTEST_SKIP() << "a sanitizer's heap does not tell";
  }
};

/// Of the joint method's objects only what few have in use is taken at once.
TEST_F(Memory, FollowsTheMostTracksAndDetections) {
  const double few = heap_mb(Method::kJoint, 100, 32);
  const double per_track = (heap_mb(Method::kJoint, 10'100, 32) - few) / 10'000.0;
  EXPECT_LT(per_track, 0.0025);
  EXPECT_GT(per_track, 0.0005);
  EXPECT_NEAR(heap_mb(Method::kJoint, 2100, 32), few + 2000.0 * per_track, 0.5);
  EXPECT_LT(few, 5.5);
}

TEST_F(Memory, IsAsTheDocumentationSays) {
  std::ifstream page(source_tree() / "docs/library.md");
  int rows = 0;
  for (std::string line; std::getline(page, line);) {
    const std::string mark = ", default";
    if (const std::size_t at = line.find(mark); at != std::string::npos) line.erase(at, mark.size());
    std::istringstream cells(line);
    std::string bar, name, unit;
    int max_tracks = 0, max_detections = 0;
    double documented_mb = 0.0;
    cells >> bar >> name >> bar >> max_tracks >> bar >> max_detections >> bar >> documented_mb >> unit;
    if (!cells || unit != "MB") continue;
    const Method method = name == "joint" ? Method::kJoint : Method::kPaper;
    EXPECT_NEAR(heap_mb(method, max_tracks, max_detections), documented_mb, 0.05 * documented_mb + 0.05)
        << line;
    ++rows;
  }
  EXPECT_EQ(rows, 4);
}

}  // namespace
}  // namespace geoloc

#endif
