// SPDX-License-Identifier: Apache-2.0
#include "tracking/known_point_matcher.hpp"

#include <utility>

#include "settings/field_checker.hpp"
#include "tracking/known_point_fields.hpp"

namespace geoloc {
namespace {

/// After so many frames that looked there an object would have been found: until then the object of a point
/// may be one not seen yet, and a neighbour be taken for it.
constexpr int kFramesToFind = 20;

}  // namespace

std::vector<std::string> KnownPoint::problems() const {
  return check_fields(*this);
}

KnownPointMatcher::KnownPointMatcher(std::vector<KnownPoint> points, int max_tracks)
    : points_(std::move(points)),
      entries_(points_.size()),
      matches_(points_.size()),
      association_(static_cast<int>(points_.size()), points_.empty() ? 0 : max_tracks) {
  open_.reserve(points_.size());
}

void KnownPointMatcher::list_open() {
  open_.clear();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (matches_[i].status != KnownPointStatus::kMatched && entries_[i].frames_covered >= kFramesToFind)
      open_.push_back(i);
  }
}

void KnownPointMatcher::add_pairings(std::size_t open, const std::vector<Candidate>& candidates,
                                     const Sigma& sigma) {
  const KnownPoint& point = points_[open_[open]];
  const double variance = sigma.own_m * sigma.own_m + point.sigma_m * point.sigma_m;
  Pairing pairing;
  pairing.look = open;
  pairing.jacobian.setZero();
  pairing.jacobian.middleCols<2>(SharedError::kFrame).diagonal().setConstant(sigma.shared_m);
  pairing.own_covariance = variance * Eigen::Matrix2d::Identity();
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (point.class_id && *point.class_id != candidates[k].class_id) continue;
    if (point_of(candidates[k].track_id)) continue;
    pairing.track = k;
    pairing.residual = entries_[open_[open]].on_ground_in_enu->head<2>() - candidates[k].position_in_enu;
    association_.add(pairing);
  }
}

bool KnownPointMatcher::match(const std::vector<Candidate>& candidates, const Sigma& sigma, double gate,
                              double ambiguity) {
  list_open();
  if (open_.empty()) return false;
  association_.begin(open_.size(), gate, ambiguity);
  for (std::size_t i = 0; i < open_.size(); ++i) add_pairings(i, candidates, sigma);
  const auto& matches = association_.solve_thoroughly();
  bool is_new = false;
  for (std::size_t i = 0; i < open_.size(); ++i) {
    KnownPointMatch& known = matches_[open_[i]];
    const Candidate* const candidate = matches[i].track ? &candidates[*matches[i].track] : nullptr;
    if (matches[i].is_ambiguous || (candidate != nullptr && !candidate->is_confirmed)) {
      known.status = KnownPointStatus::kAmbiguous;
    } else if (candidate == nullptr) {
      known.status = KnownPointStatus::kNoObject;
    } else {
      known = {KnownPointStatus::kMatched, candidate->track_id};
      is_new = true;
    }
  }
  return is_new;
}

void KnownPointMatcher::rename(std::uint64_t gone, std::uint64_t kept) {
  if (const auto point = point_of(gone)) matches_[*point].track_id = kept;
}

void KnownPointMatcher::forget(std::uint64_t track_id) {
  if (const auto point = point_of(track_id)) matches_[*point].status = KnownPointStatus::kNotCovered;
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
