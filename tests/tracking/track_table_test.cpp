// SPDX-License-Identifier: Apache-2.0
#include "tracking/track_table.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>
#include <vector>

namespace geoloc {
namespace {

TEST(TrackTable, IsFullAtItsCapacity) {
  TrackTable table(2);
  EXPECT_FALSE(table.is_full());
  table.append();
  EXPECT_FALSE(table.is_full());
  table.append();
  EXPECT_TRUE(table.is_full());
  table.remove(0);
  EXPECT_FALSE(table.is_full());
}

/// However rows come and go, each keeps its landmark, and no two have one landmark.
TEST(TrackTable, GivesEachRowALandmarkOfItsOwnForItsLife) {
  TrackTable table(8);
  std::mt19937 random(2);
  std::uint64_t next_id = 1;
  std::map<std::uint64_t, const Landmark*> landmarks;
  for (int step = 0; step < 500; ++step) {
    if (table.size() == 0 || (!table.is_full() && random() % 2 == 0)) {
      RestingObject& row = table.append();
      row.track.id = next_id++;
      landmarks[row.track.id] = row.landmark;
    } else {
      const std::size_t row = random() % table.size();
      landmarks.erase(table[row].track.id);
      table.remove(row);
    }
    ASSERT_EQ(table.size(), landmarks.size());
    std::set<const Landmark*> distinct;
    std::uint64_t before = 0;
    for (const RestingObject& row : table) {
      EXPECT_GT(row.track.id, before);  // in order of their ids
      before = row.track.id;
      ASSERT_EQ(row.landmark, landmarks.at(row.track.id));
      distinct.insert(row.landmark);
    }
    ASSERT_EQ(distinct.size(), table.size());
  }
}

/// Against a search by hand, as rows come and go.
TEST(TrackTable, FindsTheRowOfATrackAndListsTheLandmarksOfAll) {
  TrackTable table(8);
  EXPECT_EQ(table.find(1), nullptr);
  EXPECT_TRUE(table.landmarks().empty());
  std::mt19937 random(4);
  std::uint64_t next_id = 1;
  for (int step = 0; step < 200; ++step) {
    if (table.size() == 0 || (!table.is_full() && random() % 2 == 0)) {
      table.append().track.id = next_id;
      next_id += 1 + random() % 3;
    } else {
      table.remove(random() % table.size());
    }
    for (std::uint64_t id = 0; id <= next_id; ++id) {
      const RestingObject* expected = nullptr;
      for (const RestingObject& row : table) {
        if (row.track.id == id) expected = &row;
      }
      ASSERT_EQ(table.find(id), expected) << id;
    }
    const std::vector<const Landmark*>& landmarks = table.landmarks();
    ASSERT_EQ(landmarks.size(), table.size());
    for (std::size_t k = 0; k < table.size(); ++k) EXPECT_EQ(landmarks[k], table[k].landmark);
  }
}

/// It has room for as many landmarks as for rows, and they may not move.
TEST(TrackTable, GivesTheLandmarkOfARowThatIsGoneToANewOne) {
  constexpr std::size_t kRows = 4;
  TrackTable table(static_cast<int>(kRows));
  std::set<const Landmark*> given;
  for (std::size_t step = 0; step < 10 * kRows; ++step) {
    if (table.is_full()) table.remove(step % kRows);
    given.insert(table.append().landmark);
  }
  EXPECT_EQ(given.size(), kRows);
}

TEST(TrackTable, ForgetsWhatAFrameTold) {
  TrackTable table(2);
  RestingObject& row = table.append();
  row.is_seen = true;
  row.look = 3;
  row.is_in_doubt = true;
  row.detection_probability = 0.7;
  row.track.hits = 5;
  table.clear_evidence();
  EXPECT_FALSE(row.is_seen);
  EXPECT_FALSE(row.look);
  EXPECT_FALSE(row.is_in_doubt);
  EXPECT_EQ(row.detection_probability, 0.0);
  EXPECT_EQ(row.track.hits, 5);
}

}  // namespace
}  // namespace geoloc
