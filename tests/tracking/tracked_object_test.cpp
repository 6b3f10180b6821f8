// SPDX-License-Identifier: Apache-2.0
#include "tracking/tracked_object.hpp"

#include <gtest/gtest.h>

namespace geoloc {
namespace {

TEST(TrackedObject, OfTwoThatAreOneKnowsWhatBothKnew) {
  TrackedObject early, late;
  early.last_look = VehicleTime{from_seconds(3.0)};
  late.last_look = VehicleTime{from_seconds(7.0)};
  early.existence = Existence(0.2);
  late.existence = Existence(0.8);
  early.track.hits = 4;
  late.track.hits = 5;
  for (TrackedObject* object : {&early, &late}) {
    object->neighbours.seen_apart(20);
    object->neighbours.seen_as_one(20);
    object->neighbours.seen_as_one(20);
  }
  ASSERT_FALSE(early.neighbours.are_apart(20));  // neither alone would say so
  late.neighbours.seen_apart(30);
  for (const bool early_is_kept : {true, false}) {
    TrackedObject kept = early_is_kept ? early : late;
    merge_into(kept, early_is_kept ? late : early);
    EXPECT_EQ(kept.last_look, late.last_look);
    EXPECT_NEAR(kept.existence.probability(), 0.8, 1e-12);
    EXPECT_TRUE(kept.neighbours.are_apart(20));
    EXPECT_TRUE(kept.neighbours.are_apart(30));
    EXPECT_EQ(kept.track.hits, 9);
  }
}

TEST(TrackedObject, IsConfirmedUntilItIsLessProbableThanNotAndThenFromItsConfirmationOn) {
  TrackedObject object;
  object.existence = Existence(0.5);
  const auto follow = [&] {
    confirm_if_probable(object, 0.999);
    retract_if_improbable(object);
  };
  follow();
  EXPECT_FALSE(object.is_confirmed() || object.was_confirmed);
  for (int round = 0; round < 2; ++round) {
    while (object.existence.probability() < 0.999) {
      EXPECT_FALSE(object.is_confirmed());
      object.existence.hit(0.9, 2.0, 1.0);
      follow();
    }
    EXPECT_TRUE(object.is_confirmed());
    while (object.existence.probability() >= 0.5) {
      EXPECT_TRUE(object.is_confirmed());
      object.existence.miss(0.4);
      follow();
    }
    EXPECT_FALSE(object.is_confirmed());
    EXPECT_TRUE(object.was_confirmed);
  }
}

TEST(TrackedObject, OfTwoOneOfWhichWasConfirmedWasConfirmed) {
  TrackedObject confirmed, other;
  confirmed.existence = Existence(0.9999);
  confirm_if_probable(confirmed, 0.999);
  ASSERT_TRUE(confirmed.was_confirmed);
  TrackedObject kept = other;
  merge_into(kept, confirmed);
  EXPECT_TRUE(kept.was_confirmed);
  merge_into(confirmed, other);
  EXPECT_TRUE(confirmed.was_confirmed);
}

}  // namespace
}  // namespace geoloc
