// SPDX-License-Identifier: Apache-2.0
#include "common/run_score.hpp"

#include <algorithm>

namespace geoloc::apps {
namespace {

std::vector<Gaussian2> confirmed(const Session& session, const LeftOut& left_out) {
  std::vector<Gaussian2> objects;
  for (const Track& track : session.geolocator().tracks()) {
    const bool is_left_out = std::find(left_out.begin(), left_out.end(), track.id) != left_out.end();
    if (track.status == TrackStatus::kConfirmed && !is_left_out) objects.push_back(track.position_in_enu);
  }
  return objects;
}

}  // namespace

std::vector<Eigen::Vector2d> targets_in_enu(const std::vector<io::TrueTarget>& truth,
                                            const Geolocator& geolocator) {
  std::vector<Eigen::Vector2d> targets;
  if (!geolocator.local_frame()) return targets;
  for (const io::TrueTarget& target : truth) {
    targets.push_back(geolocator.local_frame()->to_local(target.position).position_in_enu);
  }
  return targets;
}

Score score_run(const Session& session, const std::vector<io::TrueTarget>& truth, const LeftOut& left_out) {
  if (!session.geolocator().local_frame())
    return score_objects({}, std::vector<Eigen::Vector2d>(truth.size()));
  std::vector<Eigen::Vector2d> objects;
  for (const Gaussian2& object : confirmed(session, left_out)) objects.push_back(object.mean);
  return score_objects(objects, targets_in_enu(truth, session.geolocator()));
}

double mean_nees_of_run(const Session& session, const std::vector<io::TrueTarget>& truth, const Score& score,
                        const LeftOut& left_out) {
  if (!session.geolocator().local_frame()) return 0.0;
  return mean_nees(confirmed(session, left_out), targets_in_enu(truth, session.geolocator()),
                   score.target_of_object);
}

}  // namespace geoloc::apps
