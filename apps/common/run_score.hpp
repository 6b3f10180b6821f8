// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/session.hpp"
#include "geoloc/evaluation/score.hpp"
#include "geoloc/io/recording/recording.hpp"

namespace geoloc::apps {

/// Objects that are not scored, by id: those whose places the run was told.
using LeftOut = std::vector<std::uint64_t>;

/// The true targets in the run's own frame; empty where no position ever came.
std::vector<Eigen::Vector2d> targets_in_enu(const std::vector<io::TrueTarget>& truth,
                                            const Geolocator& geolocator);

struct ScoredTruth {
  std::vector<io::TrueTarget> targets;
  LeftOut told;
};

/// The true targets less those that the run was told by known points that it used, and the objects that stand
/// for these.
ScoredTruth without_known_points(const Session& session, const std::vector<io::TrueTarget>& truth);

/// The run against the true targets.
Score score_run(const Session& session, const std::vector<io::TrueTarget>& truth,
                const LeftOut& left_out = {});

/// The score for a person; lengths of nothing found are dashes.
std::string words_of(const Score& score);

/// Mean NEES of the objects that `score` matched (score.hpp); 2 where the stated covariances are right.
double mean_nees_of_run(const Session& session, const std::vector<io::TrueTarget>& truth, const Score& score,
                        const LeftOut& left_out = {});

/// Height errors of the objects that `score` matched; nullopt where the method estimates no heights, or no
/// true height is known.
std::optional<HeightScore> score_heights_of_run(const Session& session,
                                                const std::vector<io::TrueTarget>& truth, const Score& score,
                                                const LeftOut& left_out = {});

}  // namespace geoloc::apps
