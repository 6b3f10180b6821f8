// SPDX-License-Identifier: Apache-2.0
#include "geoloc/tracking/track.hpp"

#include <gtest/gtest.h>

namespace geoloc {
namespace {

HostTime host_at(double time_s) {
  return HostTime{from_seconds(time_s)};
}

Track seen(std::initializer_list<Detection> detections, double first_s) {
  Track track;
  track.first_seen = host_at(first_s);
  double time_s = first_s;
  for (const Detection& detection : detections) record_detection(track, detection, host_at(time_s++));
  return track;
}

TEST(Track, KnowsHowOftenWhenAndAsWhatItWasSeen) {
  const Track track = seen({{{}, 0.9, 3}, {{}, 0.5, 4}, {{}, 0.7, 3}}, 10.0);
  EXPECT_EQ(track.hits, 3);
  EXPECT_EQ(track.first_seen, host_at(10.0));
  EXPECT_EQ(track.last_seen, host_at(12.0));
  EXPECT_EQ(track.class_id(), 3);
  EXPECT_NEAR(track.confidence(), (0.9 + 0.5 + 0.7) / 3.0, 1e-12);
}

TEST(Track, IsAsSureAsItsExistenceWhereThatIsEstimated) {
  Track track = seen({{{}, 0.9, 0}}, 0.0);
  track.existence = 0.4;
  EXPECT_EQ(track.confidence(), 0.4);
  EXPECT_EQ(Track{}.confidence(), 0.0);
}

TEST(Track, OfTwoThatAreOneHasTheRecordsOfBoth) {
  Track early = seen({{{}, 0.9, 1}, {{}, 0.8, 1}}, 1.0), late = seen({{{}, 0.7, 2}}, 50.0);
  early.penalty = 2;
  late.penalty = 5;
  for (const bool early_is_kept : {true, false}) {
    Track kept = early_is_kept ? early : late;
    merge_records(kept, early_is_kept ? late : early);
    EXPECT_EQ(kept.hits, 3);
    EXPECT_NEAR(kept.confidence(), (0.9 + 0.8 + 0.7) / 3.0, 1e-12);
    EXPECT_EQ(kept.class_id(), 1);
    EXPECT_EQ(kept.penalty, 2);
    EXPECT_EQ(kept.first_seen, host_at(1.0));
    EXPECT_EQ(kept.last_seen, host_at(50.0));
    EXPECT_EQ(kept.status, TrackStatus::kTentative);
  }
}

TEST(Track, OfTwoThatAreOneIsConfirmedWhereEitherIs) {
  Track kept, confirmed;
  const Track tentative{};
  confirmed.status = TrackStatus::kConfirmed;
  merge_records(kept, confirmed);
  EXPECT_EQ(kept.status, TrackStatus::kConfirmed);
  merge_records(kept, tentative);
  EXPECT_EQ(kept.status, TrackStatus::kConfirmed);
}

}  // namespace
}  // namespace geoloc
