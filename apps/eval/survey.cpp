// SPDX-License-Identifier: Apache-2.0
#include "eval/survey.hpp"

#include <utility>

#include "geoloc/sim/random.hpp"

namespace geoloc::apps {

Survey make_survey(std::vector<io::TrueTarget> targets, int count, std::uint64_t seed,
                   const LocalFrame& frame) {
  constexpr double kSigma_m = 0.05;
  sim::Random random(seed);
  Survey survey;
  for (int i = 0; i < count && !targets.empty(); ++i) {
    const auto chosen = targets.begin() + random.index(static_cast<int>(targets.size()));
    const Eigen::Vector2d error = kSigma_m * Eigen::Vector2d(random.normal(), random.normal());
    KnownPoint point;
    point.name = io::to_text(chosen->id);
    point.position = frame.to_geodetic(frame.to_local(chosen->position).position_in_enu + error);
    point.sigma_m = kSigma_m;
    survey.points.push_back(point);
    survey.told.push_back(*chosen);
    targets.erase(chosen);
  }
  survey.others = std::move(targets);
  return survey;
}

}  // namespace geoloc::apps
