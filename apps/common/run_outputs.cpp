// SPDX-License-Identifier: Apache-2.0
#include "common/run_outputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "geoloc/io/output/text.hpp"

namespace geoloc::apps {
namespace {

/// In the run's own frame; empty where no position ever came.
std::vector<Eigen::Vector2d> in_enu(const std::vector<io::TrueTarget>& truth, const Geolocator& geolocator) {
  std::vector<Eigen::Vector2d> targets;
  if (!geolocator.local_frame()) return targets;
  for (const io::TrueTarget& target : truth) {
    targets.push_back(geolocator.local_frame()->to_local(target.position).position_in_enu);
  }
  return targets;
}

std::vector<Gaussian2> confirmed(const Session& session, const LeftOut& left_out) {
  std::vector<Gaussian2> objects;
  for (const Track& track : session.geolocator().tracks()) {
    const bool is_left_out = std::find(left_out.begin(), left_out.end(), track.id) != left_out.end();
    if (track.status == TrackStatus::kConfirmed && !is_left_out) objects.push_back(track.position_in_enu);
  }
  return objects;
}

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

}  // namespace

io::RunRecord record_run(const Session& session, const std::vector<std::string>& class_names,
                         const std::vector<io::TrueTarget>& truth, const std::string& title) {
  const Geolocator& geolocator = session.geolocator();
  io::RunRecord run;
  run.title = title;
  run.summary = summarize(session, truth);
  run.objects = io::report_objects(geolocator, class_names);
  run.estimator = io::report_estimator(geolocator);
  run.local_frame = geolocator.local_frame();
  run.ground_height_above_home_m = geolocator.projector().config().ground_height_above_home_m;
  run.raw_fixes = session.history().raw_fixes();
  run.trajectory = session.history().trajectory();
  run.targets = in_enu(truth, geolocator);
  return run;
}

Score score_run(const Session& session, const std::vector<io::TrueTarget>& truth, const LeftOut& left_out) {
  if (!session.geolocator().local_frame())
    return score_objects({}, std::vector<Eigen::Vector2d>(truth.size()));
  std::vector<Eigen::Vector2d> objects;
  for (const Gaussian2& object : confirmed(session, left_out)) objects.push_back(object.mean);
  return score_objects(objects, in_enu(truth, session.geolocator()));
}

double consistency_of_run(const Session& session, const std::vector<io::TrueTarget>& truth,
                          const Score& score, const LeftOut& left_out) {
  if (!session.geolocator().local_frame()) return 0.0;
  return mean_nees(confirmed(session, left_out), in_enu(truth, session.geolocator()), score.target_of_object);
}

std::string summarize(const Session& session, const std::vector<io::TrueTarget>& truth) {
  const std::string unused = unused_known_points(session.geolocator());
  const std::uint64_t frames = session.frames();
  if (truth.empty()) {
    return fmt::format("{} objects from {} fixes in {} frames ({} without vehicle state)",
                       io::report_objects(session.geolocator(), {}).size(),
                       session.history().raw_fixes().size(), frames, session.frames_unusable()) +
           unused;
  }
  const Score score = score_run(session, truth);
  return fmt::format(
             "found {} / {}, RMSE {:.3f} m (relative {:.3f} m), extra {}, merged pairs {}, {} frames ({} "
             "without "
             "vehicle state)",
             score.found, score.targets, score.rmse_m, score.relative_rmse_m, score.extra, score.merged_pairs,
             frames, session.frames_unusable()) +
         unused;
}

std::string objects_to_table(const std::vector<io::ObjectReport>& objects) {
  std::string table = fmt::format("{:>5}  {:<16} {:>13} {:>14} {:>8} {:>6}  {}\n", "id", "class", "latitude",
                                  "longitude", "sigma m", "looks", "last seen (UTC)");
  for (const io::ObjectReport& object : objects) {
    fmt::format_to(std::back_inserter(table), "{:>5}  {:<16} {:>13.7f} {:>14.7f} {:>8.2f} {:>6}  {}\n",
                   object.id, io::clean_text(object.class_name, 16), object.position.latitude_deg,
                   object.position.longitude_deg, object.ellipse.sigma_major_m, object.hits,
                   io::iso8601(object.last_seen));
  }
  return table;
}

}  // namespace geoloc::apps
