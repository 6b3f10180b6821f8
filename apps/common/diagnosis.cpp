// SPDX-License-Identifier: Apache-2.0
#include "common/diagnosis.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/link_message.hpp"
#include "geoloc/io/output/object_report.hpp"

namespace geoloc::apps {
namespace {

/// Fewer are no evidence.
constexpr std::uint64_t kEnough = 5;

bool is_most(std::uint64_t part, std::uint64_t whole) {
  return 2 * part > whole;
}

bool is_nearly_all(std::uint64_t part, std::uint64_t whole) {
  return part >= kEnough && 20 * part >= 19 * whole;
}

std::string count_of(std::uint64_t part, std::uint64_t whole) {
  return part == whole ? fmt::format("all {}", whole) : fmt::format("{} of {}", part, whole);
}

bool is_apart(const HostTimeSpan& a, const HostTimeSpan& b) {
  return a.last < b.first || b.last < a.first;
}

/// The unit that frame times of frames.jsonl were written in, where they would fit the telemetry in it.
std::string unit_that_fits(const HostTimeSpan& frames, const HostTimeSpan& telemetry) {
  struct Unit {
    const char* name;
    std::int64_t us;
  };
  for (const Unit unit : {Unit{"milliseconds", 1'000}, Unit{"seconds", 1'000'000}}) {
    const Duration latest = telemetry.last.time_since_epoch() + std::chrono::hours{24};
    if (frames.last.time_since_epoch() > latest / unit.us) continue;  // the product might overflow
    const HostTimeSpan scaled{HostTime{frames.first.time_since_epoch() * unit.us},
                              HostTime{frames.last.time_since_epoch() * unit.us}};
    if (!is_apart(scaled, telemetry)) return unit.name;
  }
  return {};
}

/// Empty where some frame lies within the telemetry.
std::string frames_at_another_time(const RunCensus& census) {
  if (!census.frames || !census.telemetry || !is_apart(*census.frames, *census.telemetry)) return {};
  const std::string unit = unit_that_fits(*census.frames, *census.telemetry);
  return fmt::format(
      "all {} frames lie outside the telemetry: they are of {} to {}, the telemetry is of {} to {}{}",
      census.frame_count, io::iso8601(census.frames->first), io::iso8601(census.frames->last),
      io::iso8601(census.telemetry->first), io::iso8601(census.telemetry->last),
      unit.empty() ? ". time_us counts microseconds since 1970, UTC"
                   : ". Is time_us in " + unit + "? It counts microseconds");
}

std::string why_without_state(NoState reason, const RunFacts& facts) {
  switch (reason) {
    case NoState::kNotYet:
      return fmt::format(
          "the telemetry around them came more than frames.max_wait_s ({:g} s) late, or not at all",
          facts.max_frame_wait_s);
    case NoState::kTooOld:
      return "they were taken before the telemetry that is kept begins: do both start together, by the same "
             "clock?";
    case NoState::kInAGap:
      return fmt::format("the telemetry around them has holes of more than state.max_gap_s ({:g} s)",
                         facts.config.state.max_gap_s);
    case NoState::kNoSamples:
      return "they came before the vehicle's first attitude and position";
    case NoState::kNoGimbal:
      return kNoGimbalAngles;
  }
  return {};
}

/// Why most frames have no place; empty where most have one.
std::string frames_without_state(const RunFacts& facts) {
  const RunCensus& census = facts.census;
  const std::uint64_t located = facts.counters.frames_located;
  if (census.frame_count == 0 || is_most(located, census.frame_count)) return {};
  const std::string how_many =
      located == 0 ? "no frame was located: "
                   : fmt::format("only {} of {} frames were located: ", located, census.frame_count);
  if (located == 0 && !facts.link_fault.empty()) return how_many + facts.link_fault;
  const auto most = std::max_element(census.frames_without_state.begin(), census.frames_without_state.end());
  if (census.frames_without_vehicle >= *most)
    return how_many + "they came before the vehicle's clock was known, from its first attitudes";
  const auto reason = static_cast<NoState>(most - census.frames_without_state.begin());
  return how_many + why_without_state(reason, facts);
}

/// Empty where they look like boxes in pixels.
std::string odd_boxes(const RunFacts& facts) {
  const RunCensus& census = facts.census;
  const CameraIntrinsics& image = facts.config.camera.intrinsics;
  if (is_nearly_all(census.boxes_within_a_pixel, census.boxes))
    return fmt::format(
        "{} boxes are smaller than a pixel: are they normalised? `box` is left, top, width, height in pixels "
        "of the {} x {} image",
        count_of(census.boxes_within_a_pixel, census.boxes), image.width_px, image.height_px);
  if (census.boxes_beyond_image < kEnough || 10 * census.boxes_beyond_image < census.boxes) return {};
  const std::string beyond =
      fmt::format("{} boxes end beyond the {} x {} image", count_of(census.boxes_beyond_image, census.boxes),
                  image.width_px, image.height_px);
  if (is_nearly_all(census.boxes_like_corners, census.boxes))
    return beyond +
           ", and they reach as far as if they were left, top, right, bottom: `box` is left, top, "
           "width, height";
  return beyond +
         ": are they of this camera (camera.json, or \"camera\" in --config)? `box` is left, top, "
         "width, height in pixels of the whole image";
}

std::string why_without_fix(NoFix reason, const GeolocatorConfig& config) {
  switch (reason) {
    case NoFix::kNotFinite:
      return "are no numbers";
    case NoFix::kNoRay:
      return "lie where the lens distortion has no inverse: is \"distortion\" of the camera right?";
    case NoFix::kAboveHorizon:
      return fmt::format(
          "look above the horizon: is the mount's pitch right? It is {:g} deg, and -90 looks straight down "
          "(mount.pitch_deg of camera.json, or of \"camera\" in --config)",
          config.camera.mount.pitch_deg);
    case NoFix::kTooGrazing:
      return fmt::format("meet the ground at less than projector.min_depression_deg ({:g} deg)",
                         config.projector.min_depression_deg);
    case NoFix::kTooFar:
      return fmt::format("meet the ground beyond projector.max_range_m ({:g} m)",
                         config.projector.max_range_m);
    case NoFix::kBelowGround:
      return fmt::format(
          "were seen from below the ground: projector.ground_height_above_home_m is {:g} m, and heights of "
          "the telemetry count from home",
          config.projector.ground_height_above_home_m);
  }
  return {};
}

/// Empty where most detections were put on the ground.
std::string detections_without_place(const RunFacts& facts) {
  const Geolocator::Counters& counters = facts.counters;
  const std::uint64_t all = counters.detections + counters.detections_at_edge + counters.detections_dropped;
  if (all < kEnough) return {};
  if (is_most(counters.detections_at_edge, all))
    return fmt::format(
        "{} detections are not used, since the image's edge may cut them: they lie within edge_margin_px "
        "({:g} "
        "px) of it",
        count_of(counters.detections_at_edge, all), facts.config.edge_margin_px);
  const auto most = std::max_element(counters.no_fix.begin(), counters.no_fix.end());
  if (!is_most(*most, all)) return {};
  const auto reason = static_cast<NoFix>(most - counters.no_fix.begin());
  return fmt::format("{} detections {}", count_of(*most, all), why_without_fix(reason, facts.config));
}

/// Empty where there is an object, or nothing that could be one.
std::string nothing_confirmed(const RunFacts& facts) {
  if (facts.objects > 0 || facts.counters.frames_located == 0) return {};
  if (facts.census.boxes == 0)
    return fmt::format("no object: there is no detection in any of {} frames", facts.census.frame_count);
  if (facts.candidates == 0) return {};
  if (facts.config.method == Method::kPaper)
    return fmt::format(
        "no object is confirmed: the best of {} candidates has {} detections, paper.confirm_hits asks for {}",
        facts.candidates, facts.most_hits, facts.config.paper.confirm_hits);
  return fmt::format(
      "no object is confirmed: the best of {} candidates has {} detections and exists with probability "
      "{:.3f}, "
      "joint.confirm_probability asks for {:g}",
      facts.candidates, facts.most_hits, facts.best_existence, facts.config.joint.confirm_probability);
}

}  // namespace

RunFacts facts_of(const Session& session) {
  const Geolocator& geolocator = session.geolocator();
  RunFacts facts;
  facts.census = session.census();
  facts.counters = geolocator.counters();
  facts.config = geolocator.config();
  facts.max_frame_wait_s = seconds(session.max_frame_wait());
  if (!facts.census.telemetry) {
    facts.link_fault = "no telemetry came";
  } else {
    const io::LinkStatus link = session.link().status(facts.census.telemetry->last);
    facts.link_fault = link_message(link, geolocator).fault;
  }
  for (const Track& track : geolocator.tracks()) {
    if (track.status == TrackStatus::kConfirmed) {
      ++facts.objects;
      continue;
    }
    ++facts.candidates;
    facts.best_existence = std::max(facts.best_existence, track.existence.value_or(0.0));
    facts.most_hits = std::max(facts.most_hits, track.hits);
  }
  return facts;
}

std::vector<std::string> diagnose(const RunFacts& facts) {
  if (facts.census.frame_count == 0) return {"no frame came"};
  std::vector<std::string> sentences;
  const auto say = [&sentences](std::string sentence) {
    if (!sentence.empty()) sentences.push_back(std::move(sentence));
  };
  const std::string apart = frames_at_another_time(facts.census);
  say(apart.empty() ? frames_without_state(facts) : apart);
  const std::string boxes = odd_boxes(facts);
  say(boxes.empty() ? detections_without_place(facts) : boxes);
  if (sentences.empty()) say(nothing_confirmed(facts));
  return sentences;
}

}  // namespace geoloc::apps
