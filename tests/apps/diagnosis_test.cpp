// SPDX-License-Identifier: Apache-2.0
#include "common/diagnosis.hpp"

#include <gtest/gtest.h>

namespace geoloc::apps {
namespace {

constexpr HostTime kTakeOff{std::chrono::seconds{1'795'300'000}};

HostTimeSpan minutes_from(HostTime first, int minutes) {
  return {first, first + std::chrono::minutes{minutes}};
}

/// A run without a fault: 100 frames with a box each, one object.
RunFacts good_run() {
  RunFacts facts;
  facts.census.telemetry = facts.census.frames = minutes_from(kTakeOff, 3);
  facts.census.frame_count = facts.counters.frames = facts.counters.frames_located = 100;
  facts.census.boxes = facts.counters.detections = 100;
  facts.max_frame_wait_s = 4.0;
  facts.objects = 1;
  return facts;
}

/// None of its frames is located.
RunFacts run_without_state() {
  RunFacts facts = good_run();
  facts.counters = {};
  facts.counters.frames = facts.counters.frames_unusable = 100;
  facts.objects = 0;
  return facts;
}

std::string only_sentence(const RunFacts& facts) {
  const auto sentences = diagnose(facts);
  EXPECT_EQ(sentences.size(), 1U);
  return sentences.empty() ? "" : sentences.front();
}

#define EXPECT_SAYS(facts, words) \
  EXPECT_NE(only_sentence(facts).find(words), std::string::npos) << only_sentence(facts)

TEST(Diagnosis, OfAGoodRunIsEmpty) {
  EXPECT_TRUE(diagnose(good_run()).empty());
  RunFacts oblique = good_run();  // some boxes of the image's upper part, some frames before the telemetry
  oblique.counters.no_fix[static_cast<std::size_t>(NoFix::kAboveHorizon)] = 40;
  oblique.counters.frames_located = 60;
  oblique.counters.detections_at_edge = 30;
  oblique.census.boxes_beyond_image = 4;
  EXPECT_TRUE(diagnose(oblique).empty());
}

TEST(Diagnosis, OfNoFrameSaysSo) {
  EXPECT_SAYS(RunFacts{}, "no frame came");
}

TEST(Diagnosis, NamesTheUnitOfFrameTimesThatLieOutsideTheTelemetry) {
  RunFacts facts = run_without_state();
  for (const auto& [us, unit] : {std::pair{1'000, "milliseconds"}, std::pair{1'000'000, "seconds"}}) {
    facts.census.frames =
        HostTimeSpan{HostTime{kTakeOff.time_since_epoch() / us},
                     HostTime{(kTakeOff.time_since_epoch() + std::chrono::minutes{3}) / us}};
    EXPECT_SAYS(facts, "all 100 frames lie outside the telemetry: they are of 1970-01-");
    EXPECT_SAYS(facts, std::string("Is time_us in ") + unit);
  }
  facts.census.frames = minutes_from(kTakeOff + std::chrono::hours{2}, 3);
  EXPECT_SAYS(facts, "time_us counts microseconds since 1970, UTC");
  facts.census.frames = HostTimeSpan{HostTime::max(), HostTime::max()};
  EXPECT_SAYS(facts, "lie outside the telemetry");
}

TEST(Diagnosis, NamesTheSettingWhereNoFrameIsLocated) {
  RunFacts facts = run_without_state();
  facts.census.frames_without_vehicle = 100;
  EXPECT_SAYS(facts, "no frame was located: they came before the vehicle's clock was known");
  const std::pair<NoState, const char*> words[] = {{NoState::kNoGimbal, "camera.mount.kind"},
                                                   {NoState::kNotYet, "frames.max_wait_s (4 s)"},
                                                   {NoState::kTooOld, "before the telemetry that is kept"},
                                                   {NoState::kInAGap, "state.max_gap_s (3 s)"},
                                                   {NoState::kNoSamples, "first attitude and position"}};
  for (const auto& [reason, setting] : words) {
    facts = run_without_state();
    facts.census.frames_without_state[static_cast<std::size_t>(reason)] = 100;
    EXPECT_SAYS(facts, setting);
  }
  facts.link_fault = "vehicle 1: no position comes";
  EXPECT_SAYS(facts, "no frame was located: vehicle 1: no position comes");
  facts.counters.frames_located = 10;
  EXPECT_SAYS(facts, "only 10 of 100 frames were located: they came");
}

TEST(Diagnosis, KnowsBoxesThatAreNotInPixels) {
  RunFacts facts = good_run();
  facts.census.boxes_within_a_pixel = 100;
  EXPECT_SAYS(facts, "all 100 boxes are smaller than a pixel: are they normalised?");
  facts = good_run();
  facts.census.boxes_beyond_image = 45;
  EXPECT_SAYS(facts, "45 of 100 boxes end beyond the 1280 x 720 image: are they of this camera");
  facts.census.boxes_like_corners = 98;
  EXPECT_SAYS(facts, "left, top, right, bottom");
}

TEST(Diagnosis, NamesWhatKeepsDetectionsOffTheGround) {
  const std::pair<NoFix, const char*> words[] = {
      {NoFix::kNotFinite, "are no numbers"},
      {NoFix::kNoRay, "distortion"},
      {NoFix::kAboveHorizon, "is the mount's pitch right? It is -90 deg"},
      {NoFix::kTooGrazing, "projector.min_depression_deg (5 deg)"},
      {NoFix::kTooFar, "projector.max_range_m (1000 m)"},
      {NoFix::kBelowGround, "projector.ground_height_above_home_m"}};
  for (const auto& [reason, setting] : words) {
    RunFacts facts = good_run();
    facts.counters.no_fix[static_cast<std::size_t>(reason)] = 60;
    EXPECT_SAYS(facts, "60 of 100 detections ");
    EXPECT_SAYS(facts, setting);
  }
  RunFacts facts = good_run();
  facts.counters.detections = 20;
  facts.counters.detections_at_edge = 80;
  EXPECT_SAYS(facts, "edge_margin_px (2 px)");
}

TEST(Diagnosis, NamesTheThresholdThatNoObjectReached) {
  RunFacts facts = good_run();
  facts.objects = 0;
  facts.candidates = 7;
  facts.best_existence = 0.42;
  facts.most_hits = 3;
  EXPECT_SAYS(facts,
              "the best of 7 candidates has 3 detections and exists with probability 0.420, "
              "joint.confirm_probability asks for 0.999");
  facts.config.method = Method::kPaper;
  EXPECT_SAYS(facts, "the best of 7 candidates has 3 detections, paper.confirm_hits asks for 5");
  facts.census.boxes = 0;
  EXPECT_SAYS(facts, "there is no detection in any of 100 frames");
}

}  // namespace
}  // namespace geoloc::apps
