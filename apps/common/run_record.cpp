// SPDX-License-Identifier: Apache-2.0
#include "common/run_record.hpp"

#include <fmt/format.h>

#include "common/clock_message.hpp"
#include "common/diagnosis.hpp"
#include "common/gimbal_news.hpp"
#include "common/run_score.hpp"
#include "common/state_news.hpp"
#include "common/view_contradiction.hpp"
#include "geoloc/io/output/object_report.hpp"
#include "geoloc/projection/projector.hpp"
#include "geoloc/state/state_provider.hpp"

namespace geoloc::apps {
namespace {

/// What became of the known points, where it is not what the user expects.
std::string unused_known_points(const Geolocator& geolocator) {
  std::string lines;
  const auto& entries = geolocator.known_points();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const char* reason = nullptr;
    if (entries[i].status == KnownPointStatus::kNotCovered)
      reason = "the camera did not look there long enough";
    if (entries[i].status == KnownPointStatus::kNoObject)
      reason = "no object there agrees with it and with the other known points: check its coordinates";
    if (entries[i].status == KnownPointStatus::kAmbiguous) reason = "several objects may be the one";
    if (reason != nullptr)
      lines += fmt::format("\nknown point {} not used: {}", geolocator.config().known_points[i].name, reason);
  }
  return lines;
}

/// An elevation model of another place says nothing of this one.
std::string useless_terrain(const Geolocator& geolocator) {
  const HeightGrid* const terrain = geolocator.config().terrain.get();
  if (terrain == nullptr || !geolocator.local_frame()) return {};
  const auto below_start = terrain->at(geolocator.local_frame()->origin());
  if (below_start && below_start->beyond_m == 0.0) return {};
  return "\nthe elevation model of --ground has no height where the flight began: is it of another place?";
}

/// Empty where all frames were whole.
std::string count_of_damaged(const Session& session) {
  if (session.frames_damaged() == 0) return {};
  return fmt::format("{} more frames were damaged on their way and left out", session.frames_damaged());
}

/// Why the score may not be that of the run; empty where it is.
std::string doubts(const Score& score, const LeftOut& told) {
  std::string lines;
  if (!told.empty())
    lines += fmt::format(
        "\nleft out of the score, since known points tell their places: {} objects and their targets",
        told.size());
  if (score.found == 0 && score.nearest_m)
    lines += fmt::format(
        "\nno object is within {:g} m of a target: the nearest is {:.1f} m away. Are the true targets those "
        "of "
        "this flight, in the same datum?",
        kFarthestMatch_m, *score.nearest_m);
  return lines;
}

std::string remark_on_view(const Session& session) {
  const auto& heard = session.census().telemetry;
  if (!heard) return {};
  return view_contradiction(session.link().status(heard->last),
                            session.geolocator().config().camera.intrinsics);
}

/// What a person should know besides the figures.
std::string remarks(const Session& session) {
  const Geolocator& geolocator = session.geolocator();
  std::string lines;
  for (const std::string& news : {count_of_jumps(geolocator.state().counters()), count_of_turned(geolocator),
                                  remark_on_gimbal(geolocator), remark_on_view(session),
                                  clock_message(session), count_of_damaged(session)}) {
    if (!news.empty()) lines += "\n" + news;
  }
  lines += unused_known_points(geolocator) + useless_terrain(geolocator);
  for (const std::string& sentence : diagnose(facts_of(session))) lines += "\n" + sentence;
  return lines;
}

}  // namespace

io::RunRecord record_run(const Session& session, const std::vector<std::string>& class_names,
                         const std::vector<io::TrueTarget>& truth, const std::string& title) {
  const Geolocator& geolocator = session.geolocator();
  io::RunRecord run;
  run.title = title;
  run.summary = summarize_run(session, truth);
  run.objects = io::report_objects(geolocator, class_names);
  run.estimator = io::report_estimator(geolocator);
  run.estimator.counters.frames_damaged = session.frames_damaged();
  run.local_frame = geolocator.local_frame();
  run.ground_height_above_home_m = geolocator.projector().config().ground_height_above_home_m;
  run.raw_fixes = session.history().raw_fixes();
  run.trajectory = session.history().trajectory();
  run.targets = targets_in_enu(truth, geolocator);
  return run;
}

std::string summarize_run(const Session& session, const std::vector<io::TrueTarget>& truth) {
  const std::string also = remarks(session);
  const std::uint64_t frames = session.frames();
  if (truth.empty()) {
    return fmt::format("{} objects from {} fixes in {} frames ({} without vehicle state)",
                       io::report_objects(session.geolocator(), {}).size(), session.history().fixes(), frames,
                       session.frames_unusable()) +
           also;
  }
  const auto [scored, told] = without_known_points(session, truth);
  const Score score = score_run(session, scored, told);
  return words_of(score) +
         fmt::format(", {} frames ({} without vehicle state)", frames, session.frames_unusable()) +
         doubts(score, told) + also;
}

}  // namespace geoloc::apps
