// SPDX-License-Identifier: Apache-2.0
#include "tracking/published_tracks.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace geoloc {
namespace {

/// Whatever place is told, right or wrong, as tracks come, change and go.
TEST(PublishedTracks, AreThoseThatWereSetInOrderOfTheirIds) {
  PublishedTracks tracks(50);
  std::map<std::uint64_t, int> expected;
  std::mt19937 random(9);
  for (int step = 0; step < 5000; ++step) {
    Track track;
    track.id = 1 + random() % 50;
    track.hits = step;
    std::size_t place = random() % 60;
    if (step % 4 == 3) {
      tracks.remove(track.id);
      expected.erase(track.id);
      EXPECT_EQ(tracks.find(track.id, place), nullptr);
    } else {
      tracks.set(track, place);
      expected[track.id] = step;
      ASSERT_EQ(tracks.all()[place].id, track.id);
      EXPECT_EQ(tracks.find(track.id, place)->hits, step);
    }
    ASSERT_EQ(tracks.all().size(), expected.size());
    auto next = expected.begin();
    for (const Track& found : tracks.all()) {
      ASSERT_EQ(found.id, next->first);
      ASSERT_EQ(found.hits, next->second);
      ++next;
    }
  }
}

}  // namespace
}  // namespace geoloc
