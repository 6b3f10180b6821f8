// SPDX-License-Identifier: Apache-2.0
#include "geoloc/fleet/object_ids.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "synthetic_fleet.hpp"

namespace geoloc {
namespace {

constexpr std::size_t kTargets = 12;

/// The map's id of each target, by the targets' numbers.
std::map<std::uint64_t, std::uint64_t> ids_of_targets(const FusedMap& map, const Fleet& fleet) {
  std::map<std::uint64_t, std::uint64_t> ids;
  for (const FusedObject& object : map.objects)
    ids[testing::target_of(object.contributions.front(), map, fleet)] = object.id;
  return ids;
}

FusedMap fuse_with(const Fleet& fleet, ObjectIds& ids) {
  FusedMap map = fuse(fleet);
  keep_ids(fleet, ids, map);
  return map;
}

class ObjectIdsTest : public ::testing::Test {
 protected:
  std::mt19937 random_{11};
  std::vector<Eigen::Vector3d> targets_ = testing::clustered_targets(kTargets, random_);

  FlightSummary fly(const std::string& name, double share = 1.0) {
    return testing::draw_flight(name, targets_, {}, random_, share);
  }
};

TEST_F(ObjectIdsTest, ObjectsKeepTheirIdsWhateverFlightsCome) {
  Fleet fleet;
  ObjectIds ids;
  std::map<std::uint64_t, std::uint64_t> before;
  for (const char* name : {"m", "z", "a", "n", "b"}) {  // a flight named "a" comes first in the map
    take(fly(name, 0.8), fleet);
    const auto now = ids_of_targets(fuse_with(fleet, ids), fleet);
    for (const auto& [target, id] : before) {
      ASSERT_EQ(now.count(target), 1u);
      EXPECT_EQ(now.at(target), id) << "of target " << target << ", after flight " << name;
    }
    before = now;
  }
  EXPECT_EQ(before.size(), kTargets);
}

TEST_F(ObjectIdsTest, NoTwoObjectsHaveOneIdAndNoneIsGivenAgain) {
  Fleet fleet;
  take(fly("a"), fleet);
  ObjectIds ids;
  std::set<std::uint64_t> had;
  for (const FusedObject& object : fuse_with(fleet, ids).objects) EXPECT_TRUE(had.insert(object.id).second);
  for (FlightSummary::Object& object : fleet.at("a").objects) object.id += 100;  // other objects altogether
  for (const FusedObject& object : fuse_with(fleet, ids).objects) EXPECT_TRUE(had.insert(object.id).second);
}

TEST_F(ObjectIdsTest, OfTwoObjectsThatBecomeOneTheIdOfMoreContributionsStays) {
  Fleet fleet;
  for (const char* name : {"a", "b", "c"}) take(fly(name), fleet);
  ObjectIds ids;
  FusedMap map = fuse_with(fleet, ids);
  const std::uint64_t right = map.objects.front().id;
  const Contribution strayed = map.objects.front().contributions.front();
  ids.of[map.flights[strayed.flight].identity.flight]
        [fleet.at(map.flights[strayed.flight].identity.flight).objects[strayed.object].id] = ids.next++;
  map = fuse_with(fleet, ids);
  EXPECT_EQ(map.objects.front().id, right);
  EXPECT_EQ(map.objects.front().contributions.size(), 3u);
}

TEST_F(ObjectIdsTest, AnObjectThatIsBackHasItsIdAgain) {
  Fleet fleet;
  take(fly("a"), fleet);
  ObjectIds ids;
  const auto before = ids_of_targets(fuse_with(fleet, ids), fleet);
  const FlightSummary whole = fleet.at("a");
  fleet.at("a").objects.resize(6);
  fleet.at("a").shared_error.conservativeResize(18, Eigen::NoChange);
  EXPECT_EQ(fuse_with(fleet, ids).objects.size(), 6u);
  fleet.at("a") = whole;
  EXPECT_EQ(ids_of_targets(fuse_with(fleet, ids), fleet), before);
}

TEST_F(ObjectIdsTest, WhatIsRememberedIsBounded) {
  Fleet fleet;
  take(fly("a"), fleet);
  ObjectIds ids;
  for (int i = 0; i < 300; ++i) {
    for (FlightSummary::Object& object : fleet.at("a").objects) object.id += kTargets;
    fuse_with(fleet, ids);
  }
  EXPECT_LE(ids.of.at("a").size(), 2 * kTargets + 1000);
}

}  // namespace
}  // namespace geoloc
