// SPDX-License-Identifier: Apache-2.0
#include "common/run_score.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace geoloc::apps {
namespace {

std::vector<const Track*> confirmed(const Session& session, const LeftOut& left_out) {
  std::vector<const Track*> objects;
  for (const Track& track : session.geolocator().tracks()) {
    const bool is_left_out = std::find(left_out.begin(), left_out.end(), track.id) != left_out.end();
    if (track.status == TrackStatus::kConfirmed && !is_left_out) objects.push_back(&track);
  }
  return objects;
}

std::string metres(const std::optional<double>& length_m) {
  return length_m ? fmt::format("{:.3f} m", *length_m) : "–";
}

}  // namespace

std::string words_of(const Score& score) {
  return fmt::format("found {} / {}, RMSE {} (relative {}), extra {}, merged pairs {}", score.found,
                     score.targets, metres(score.rmse_m), metres(score.relative_rmse_m), score.extra,
                     score.merged_pairs);
}

std::vector<Eigen::Vector2d> targets_in_enu(const std::vector<io::TrueTarget>& truth,
                                            const Geolocator& geolocator) {
  std::vector<Eigen::Vector2d> targets;
  if (!geolocator.local_frame()) return targets;
  for (const io::TrueTarget& target : truth) {
    targets.push_back(geolocator.local_frame()->to_local(target.position).position_in_enu);
  }
  return targets;
}

ScoredTruth without_known_points(const Session& session, const std::vector<io::TrueTarget>& truth) {
  const Geolocator& geolocator = session.geolocator();
  ScoredTruth scored;
  std::vector<Eigen::Vector2d> known_in_enu;
  for (std::size_t i = 0; i < geolocator.known_points().size() && geolocator.local_frame(); ++i) {
    const KnownPointMatch& match = geolocator.known_points()[i];
    if (match.status != KnownPointStatus::kMatched) continue;
    scored.told.push_back(match.track_id);
    const Geodetic place = geolocator.config().known_points[i].position;
    known_in_enu.push_back(geolocator.local_frame()->to_local(place).position_in_enu);
  }
  const auto is_known = score_objects(targets_in_enu(truth, geolocator), known_in_enu).target_of_object;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (i >= is_known.size() || !is_known[i]) scored.targets.push_back(truth[i]);
  }
  return scored;
}

Score score_run(const Session& session, const std::vector<io::TrueTarget>& truth, const LeftOut& left_out) {
  if (!session.geolocator().local_frame())
    return score_objects({}, std::vector<Eigen::Vector2d>(truth.size()));
  std::vector<Eigen::Vector2d> objects;
  for (const Track* object : confirmed(session, left_out)) objects.push_back(object->position_in_enu.mean);
  return score_objects(objects, targets_in_enu(truth, session.geolocator()));
}

double mean_nees_of_run(const Session& session, const std::vector<io::TrueTarget>& truth, const Score& score,
                        const LeftOut& left_out) {
  if (!session.geolocator().local_frame()) return 0.0;
  std::vector<Gaussian2> objects;
  for (const Track* object : confirmed(session, left_out)) objects.push_back(object->position_in_enu);
  return mean_nees(objects, targets_in_enu(truth, session.geolocator()), score.target_of_object);
}

std::optional<HeightScore> score_heights_of_run(const Session& session,
                                                const std::vector<io::TrueTarget>& truth, const Score& score,
                                                const LeftOut& left_out) {
  std::vector<double> errors_m;
  const std::vector<const Track*> objects = confirmed(session, left_out);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const auto target = score.target_of_object[i];
    if (!target || !objects[i]->height || !truth[*target].height_above_home_m) continue;
    errors_m.push_back(objects[i]->height->above_home_m - *truth[*target].height_above_home_m);
  }
  if (errors_m.empty()) return std::nullopt;
  return score_heights(errors_m);
}

}  // namespace geoloc::apps
