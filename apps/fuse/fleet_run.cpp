// SPDX-License-Identifier: Apache-2.0
#include "fuse/fleet_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "common/run_score.hpp"
#include "fuse/survey.hpp"
#include "geoloc/evaluation/score.hpp"
#include "geoloc/io/fleet/fused_report.hpp"

namespace geoloc::apps {
namespace {

void leave_out_nearest(const Eigen::Vector2d& place, std::vector<Eigen::Vector2d>& targets) {
  const auto nearest = std::min_element(targets.begin(), targets.end(), [&](const auto& a, const auto& b) {
    return (a - place).squaredNorm() < (b - place).squaredNorm();
  });
  if (nearest != targets.end()) targets.erase(nearest);
}

/// The score without the survey: its objects, and the targets nearest to them, are left out.
std::string score_of(const io::RunRecord& run) {
  std::vector<Eigen::Vector2d> places, targets = run.targets;
  std::vector<Gaussian2> gaussians;
  for (std::size_t i = 0; i < run.objects.size(); ++i) {
    const io::ObjectReport& object = run.objects[i];
    if (is_surveyed(*run.fused_map, run.fused_map->objects[i])) {
      leave_out_nearest(object.position_in_enu, targets);
      continue;
    }
    places.push_back(object.position_in_enu);
    gaussians.push_back({object.position_in_enu, object.covariance_in_enu});
  }
  const Score score = score_objects(places, targets);
  return words_of(score) +
         fmt::format(", NEES {:.2f} (2 is right)", mean_nees(gaussians, targets, score.target_of_object));
}

}  // namespace

io::RunRecord fuse_to_run(const Fleet& fleet, const FuseOptions& options,
                          const std::vector<io::TrueTarget>& truth, ObjectIds& ids) {
  auto map = std::make_shared<FusedMap>(fuse(fleet, options.fusion));
  drop_unseen(*map);
  keep_ids(fleet, ids, *map);
  const std::size_t flights = fleet.size() - fleet.count(kSurvey);
  io::RunRecord run;
  run.title = fmt::format("geoloc: {} flights", flights);
  run.objects = io::report_objects(*map, options.class_names);
  run.flights = io::report_flights(*map, fleet);
  run.local_frame = map->frame;
  run.summary = fmt::format("{} objects of {} flights", run.objects.size(), flights);
  if (map->frame) {
    for (const io::TrueTarget& target : truth)
      run.targets.push_back(map->frame->to_local(target.position).position_in_enu);
  }
  run.fused_map = std::move(map);
  if (!run.targets.empty()) run.summary += "\n" + score_of(run);
  run.object_ids = std::make_shared<const ObjectIds>(ids);
  return run;
}

}  // namespace geoloc::apps
