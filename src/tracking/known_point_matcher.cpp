// SPDX-License-Identifier: Apache-2.0
#include "tracking/known_point_matcher.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geoloc/geometry/angles.hpp"
#include "geometry/room.hpp"
#include "settings/field_checker.hpp"
#include "tracking/gaussian.hpp"
#include "tracking/known_point_fields.hpp"

namespace geoloc {
namespace {

/// What hides an object from one frame hides it from those that follow within a second.
constexpr double kIndependentLooks_s = 1.0;
/// However often the camera looked there: a few points in a thousand have no object (any more), or one that
/// the detector does not know, or that is lost for a while.
constexpr double kGone = 3e-3;
/// Objects stand so thick about a point as they do within so far of it, and not less than one to 100 m^2.
constexpr double kAround_m = 5.0, kLeastDensity = 0.01;
/// One for each object that it may be, and that it is none; bounded, since each takes an assignment.
constexpr std::size_t kExplanationsPerPoint = 17, kMostExplanations = 200;
/// As many solutions in turn say the same before a point is matched.
constexpr int kSolutionsToProve = 3;
/// In 250 points one may be taken for another's object that stands where its own was not seen
/// (2 ln 250).
constexpr double kCertainty = 11.0;

std::size_t most_explanations(std::size_t points) {
  return std::min(kMostExplanations, 1 + kExplanationsPerPoint * points);
}

}  // namespace

std::vector<std::string> KnownPoint::problems() const {
  return check_fields(*this);
}

KnownPointMatcher::KnownPointMatcher(std::vector<KnownPoint> points, int max_tracks)
    : points_(std::move(points)),
      association_(static_cast<int>(points_.size()), points_.empty() ? 0 : max_tracks,
                   most_explanations(points_.size())) {
  take_room(this, points_, max_tracks);
}

std::size_t KnownPointMatcher::take_room(KnownPointMatcher* self, const std::vector<KnownPoint>& points,
                                         int max_tracks) {
  std::size_t bytes = room::bytes_of_copy(points);
  for (const KnownPoint& point : points) bytes += room::bytes_of_copy(point.name);
  return bytes + room::resize(self, &KnownPointMatcher::entries_, points.size()) +
         room::resize(self, &KnownPointMatcher::matches_, points.size()) +
         room::reserve(self, &KnownPointMatcher::open_, points.size()) +
         JointAssociation::take_room(nullptr, static_cast<int>(points.size()),
                                     points.empty() ? 0 : max_tracks, most_explanations(points.size()));
}

/// A first frame says all that a look can say.
void KnownPointMatcher::look_at(Entry& entry, VehicleTime now, double found) {
  const double pause_s = entry.covered_at ? seconds(now - *entry.covered_at) : kIndependentLooks_s;
  const double share = std::clamp(pause_s / kIndependentLooks_s, 0.0, 1.0);
  entry.unseen *= std::pow(1.0 - found, share);
  entry.covered_at = now;
}

/// The density of objects that may stand there while the point's own was not seen, times a factor that asks
/// for that certainty.
double KnownPointMatcher::density_of_others(std::size_t open, const std::vector<Candidate>& candidates,
                                            double ambiguity) const {
  const Entry& entry = entries_[open_[open]];
  const auto around = std::count_if(candidates.begin(), candidates.end(), [&](const Candidate& candidate) {
    return (candidate.position_in_enu - entry.on_ground_in_enu->head<2>()).norm() < kAround_m;
  });
  const double density = std::max(kLeastDensity, static_cast<double>(around) / (kPi * kAround_m * kAround_m));
  return density * std::max(entry.unseen, kGone) * std::exp(0.5 * (kCertainty - ambiguity));
}

void KnownPointMatcher::list_open() {
  open_.clear();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (matches_[i].status != KnownPointStatus::kMatched && entries_[i].covered_at) open_.push_back(i);
  }
}

void KnownPointMatcher::add_pairings(std::size_t open, const std::vector<Candidate>& candidates,
                                     double shared_sigma_m) {
  const KnownPoint& point = points_[open_[open]];
  Pairing pairing;
  pairing.look = open;
  pairing.jacobian.setZero();
  pairing.jacobian.middleCols<2>(SharedError::kFrame).diagonal().setConstant(shared_sigma_m);
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (point.class_id && *point.class_id != candidates[k].class_id) continue;
    if (point_of(candidates[k].track_id)) continue;
    const double variance = std::pow(candidates[k].own_sigma_m, 2) + point.sigma_m * point.sigma_m;
    pairing.own_covariance = variance * Eigen::Matrix2d::Identity();
    pairing.track = k;
    pairing.residual = entries_[open_[open]].on_ground_in_enu->head<2>() - candidates[k].position_in_enu;
    association_.add(pairing);
  }
}

/// Solutions follow each other while the first looks at an object come in, which move it by more than they
/// should: several have to say the same.
bool KnownPointMatcher::is_proven(Entry& entry, std::uint64_t track_id) {
  if (entry.likely_id != track_id) entry.likely_for = 0;
  entry.likely_id = track_id;
  return ++entry.likely_for >= kSolutionsToProve;
}

/// What one solution says of a point.
KnownPointStatus KnownPointMatcher::status_of(const JointAssociation::Match& match,
                                              const Candidate* candidate, double gate) const {
  if (match.is_ambiguous || (candidate != nullptr && !candidate->is_confirmed))
    return KnownPointStatus::kAmbiguous;
  const bool agrees = candidate != nullptr && distance_squared(match) <= gate;
  return agrees ? KnownPointStatus::kMatched : KnownPointStatus::kNoObject;
}

/// The match's squared distance by itself, whatever the other points say of the shared error.
double KnownPointMatcher::distance_squared(const JointAssociation::Match& match) const {
  const JointAssociation::Match alone = association_.match_of(association_.pairings()[match.pairing]);
  return mahalanobis_squared(alone.innovation, alone.innovation_covariance);
}

bool KnownPointMatcher::match(const std::vector<Candidate>& candidates, double shared_sigma_m, double gate,
                              double ambiguity) {
  list_open();
  if (open_.empty()) return false;
  // A candidate beyond the gate is not matched, but may be as likely as one within.
  association_.begin(open_.size(), gate + ambiguity, ambiguity);
  for (std::size_t i = 0; i < open_.size(); ++i) {
    association_.expect_new(i, density_of_others(i, candidates, ambiguity));
    add_pairings(i, candidates, shared_sigma_m);
  }
  const auto& matches = association_.solve_thoroughly();
  bool is_new = false;
  for (std::size_t i = 0; i < open_.size(); ++i) {
    KnownPointMatch& known = matches_[open_[i]];
    Entry& entry = entries_[open_[i]];
    const Candidate* const candidate = matches[i].track ? &candidates[*matches[i].track] : nullptr;
    known.status = status_of(matches[i], candidate, gate);
    if (known.status != KnownPointStatus::kMatched) {
      entry.likely_for = 0;
    } else if (!is_proven(entry, candidate->track_id)) {
      known.status = KnownPointStatus::kAmbiguous;
    } else {
      known.track_id = candidate->track_id;
      is_new = true;
    }
  }
  return is_new;
}

void KnownPointMatcher::rename(std::uint64_t gone, std::uint64_t kept) {
  if (const auto point = point_of(gone)) matches_[*point].track_id = kept;
}

void KnownPointMatcher::forget(std::uint64_t track_id) {
  const auto point = point_of(track_id);
  if (!point) return;
  matches_[*point].status = KnownPointStatus::kNotCovered;
  entries_[*point].unseen = 1.0;  // from now on
  entries_[*point].covered_at.reset();
}

std::optional<std::size_t> KnownPointMatcher::point_of(std::uint64_t track_id) const {
  for (std::size_t i = 0; i < matches_.size(); ++i) {
    if (matches_[i].status == KnownPointStatus::kMatched && matches_[i].track_id == track_id) return i;
  }
  return std::nullopt;
}

std::optional<KnownPointMatcher::Survey> KnownPointMatcher::survey_of(std::uint64_t track_id) const {
  const auto point = point_of(track_id);
  if (!point) return std::nullopt;
  const KnownPoint& known = points_[*point];
  return Survey{entries_[*point].on_ground_in_enu->head<2>(), known.sigma_m, known.height_m - level_m(),
                known.sigma_height_m};
}

/// Height of the level ground in the points' own datum: such that they stand on the ground in the mean. What
/// that is off by, the height of the camera is off by too, which is unknown anyway.
double KnownPointMatcher::level_m() const {
  double sum_m = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!(points_[i].sigma_height_m > 0.0)) continue;
    sum_m += points_[i].height_m - entries_[i].on_ground_in_enu->z();
    ++count;
  }
  return count > 0 ? sum_m / count : 0.0;
}

}  // namespace geoloc
