// SPDX-License-Identifier: Apache-2.0
#include "tracking/place_index.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <random>
#include <set>

namespace geoloc {
namespace {

/// Against all places one by one, as they come, move and go.
TEST(PlaceIndex, FindsEveryPlaceInAnAreaOnce) {
  PlaceIndex index(20.0);
  std::map<std::uint32_t, Eigen::Vector2d> places;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> along(-400.0, 400.0), length(0.0, 300.0);
  for (int step = 0; step < 30'000; ++step) {
    const auto key = static_cast<std::uint32_t>(random() % 20'000);
    const Eigen::Vector2d place(along(random), along(random));
    const bool is_known = places.count(key) > 0;
    if (is_known && step % 3 == 0) {
      index.erase(key);
      places.erase(key);
    } else {
      is_known ? index.move(key, place) : index.insert(key, place);
      places[key] = place;
    }
    ASSERT_EQ(index.size(), places.size());
    if (step % 500 != 0) continue;
    const Eigen::Vector2d corner(along(random), along(random));
    const Eigen::AlignedBox2d area(corner, corner + Eigen::Vector2d(length(random), length(random)));
    std::multiset<std::uint32_t> found;
    index.for_each_near(area, [&](std::uint32_t near) { found.insert(near); });
    for (const auto& [known, at] : places)
      ASSERT_TRUE(found.count(known) == 1 || (!area.contains(at) && found.count(known) == 0)) << known;
    for (const std::uint32_t near : found) ASSERT_TRUE(places.count(near) > 0) << near;
  }
}

TEST(PlaceIndex, LooksAtTheCellsOfAnAreaAlone) {
  PlaceIndex index(20.0);
  for (std::uint32_t key = 0; key < 10'000; ++key)
    index.insert(key, {10.0 * (key % 100), 10.0 * (key / 100.0)});
  int found = 0;
  index.for_each_near({Eigen::Vector2d(205.0, 205.0), Eigen::Vector2d(215.0, 215.0)},
                      [&](std::uint32_t) { ++found; });
  EXPECT_GT(found, 0);
  EXPECT_LE(found, 6);
}

TEST(PlaceIndex, BearsPlacesAndAreasBeyondTheEarth) {
  PlaceIndex index(20.0);
  index.insert(0, {1e300, -1e300});
  index.insert(1, {0.0, 0.0});
  const double far = std::numeric_limits<double>::max();
  int found = 0;
  index.for_each_near({Eigen::Vector2d(-far, -far), Eigen::Vector2d(far, far)},
                      [&](std::uint32_t) { ++found; });
  EXPECT_EQ(found, 2);
}

}  // namespace
}  // namespace geoloc
