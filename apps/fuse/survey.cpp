// SPDX-License-Identifier: Apache-2.0
#include "fuse/survey.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace geoloc::apps {
namespace {

constexpr double kSigmaOfNoHeight_m = 1000.0;
constexpr double kVotes = 1000.0;  // of a class that was told

}  // namespace

FlightSummary summary_of_survey(const std::vector<KnownPoint>& points) {
  FlightSummary survey;
  survey.identity = {kSurvey, "", std::numeric_limits<std::uint64_t>::max()};  // nothing replaces it
  survey.origin = points.front().position;
  const LocalFrame frame(survey.origin);
  for (const KnownPoint& point : points) {
    FlightSummary::Object object;
    object.id = survey.objects.size() + 1;
    object.position_in_enu << frame.to_local(point.position).position_in_enu, point.height_m;
    const double up_m = point.sigma_height_m > 0.0 ? point.sigma_height_m : kSigmaOfNoHeight_m;
    object.own_covariance = Eigen::Vector3d(point.sigma_m, point.sigma_m, up_m).cwiseAbs2().asDiagonal();
    object.existence = 1.0;
    if (point.class_id) object.class_votes.add(*point.class_id, kVotes);
    object.first_seen = HostTime::max();  // any look is earlier, and later
    object.last_seen = HostTime::min();
    survey.objects.push_back(object);
  }
  survey.shared_error.setZero(3 * static_cast<Eigen::Index>(points.size()), 0);
  return survey;
}

void drop_unseen(FusedMap& map) {
  auto& objects = map.objects;
  objects.erase(std::remove_if(objects.begin(), objects.end(),
                               [](const FusedObject& object) { return object.hits == 0; }),
                objects.end());
}

bool is_surveyed(const FusedMap& map, const FusedObject& object) {
  return std::any_of(object.contributions.begin(), object.contributions.end(),
                     [&](const Contribution& contribution) {
                       return map.flights[contribution.flight].identity.flight == kSurvey;
                     });
}

}  // namespace geoloc::apps
