// SPDX-License-Identifier: Apache-2.0
#include "geoloc/tracking/known_points.hpp"

#include <algorithm>
#include <cmath>

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

KnownPoints::KnownPoints(std::vector<KnownPoint> points, int max_tracks)
    : points_(std::move(points)),
      association_(static_cast<int>(points_.size()), points_.empty() ? 0 : max_tracks) {
  entries_.resize(points_.size());
  open_.reserve(points_.size());
}

void KnownPoints::place(const LocalFrame& frame) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    entries_[i].position_in_enu = frame.to_local(points_[i].position).position_in_enu;
    entries_[i].sigma_m = points_[i].sigma_m;
    entries_[i].class_id = points_[i].class_id;
  }
  is_placed_ = true;
}

bool KnownPoints::match(const std::vector<Candidate>& candidates, double shared_sigma_m, double own_sigma_m,
                        double gate, double ambiguity) {
  open_.clear();
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (entries_[i].status != KnownPointStatus::kMatched && entries_[i].frames_covered >= kFramesToFind)
      open_.push_back(i);
  }
  if (open_.empty()) return false;

  association_.begin(open_.size(), gate, ambiguity);
  Pairing pairing;
  pairing.jacobian.setZero();
  pairing.jacobian.middleCols<2>(SharedError::kFrame).diagonal().setConstant(shared_sigma_m);
  for (std::size_t i = 0; i < open_.size(); ++i) {
    const Entry& entry = entries_[open_[i]];
    const double variance = own_sigma_m * own_sigma_m + entry.sigma_m * entry.sigma_m;
    pairing.look = static_cast<int>(i);
    pairing.own_covariance = variance * Eigen::Matrix2d::Identity();
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      if (entry.class_id && *entry.class_id != candidates[k].class_id) continue;
      if (of_track(candidates[k].track_id) != nullptr) continue;
      pairing.track = static_cast<int>(k);
      pairing.residual = entry.position_in_enu - candidates[k].position_in_enu;
      association_.add(pairing);
    }
  }
  const auto& matches = association_.solve_thoroughly();
  bool is_new = false;
  for (std::size_t i = 0; i < open_.size(); ++i) {
    Entry& entry = entries_[open_[i]];
    const Candidate* const candidate = matches[i].track == JointAssociation::kNone
                                           ? nullptr
                                           : &candidates[static_cast<std::size_t>(matches[i].track)];
    if (matches[i].is_ambiguous || (candidate != nullptr && !candidate->is_confirmed)) {
      entry.status = KnownPointStatus::kAmbiguous;
    } else if (candidate == nullptr) {
      entry.status = KnownPointStatus::kNoObject;
    } else {
      entry.status = KnownPointStatus::kMatched;
      entry.track_id = candidate->track_id;
      is_new = true;
    }
  }
  return is_new;
}

void KnownPoints::rename(std::uint64_t gone, std::uint64_t kept) {
  for (Entry& entry : entries_) {
    if (entry.status == KnownPointStatus::kMatched && entry.track_id == gone) entry.track_id = kept;
  }
}

void KnownPoints::forget(std::uint64_t track_id) {
  for (Entry& entry : entries_) {
    if (entry.status == KnownPointStatus::kMatched && entry.track_id == track_id)
      entry.status = KnownPointStatus::kNotCovered;
  }
}

const KnownPoints::Entry* KnownPoints::of_track(std::uint64_t track_id) const {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    return entry.status == KnownPointStatus::kMatched && entry.track_id == track_id;
  });
  return found == entries_.end() ? nullptr : &*found;
}

}  // namespace geoloc
