// SPDX-License-Identifier: Apache-2.0
#include "geoloc/state/zoom_history.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace geoloc {
namespace {

/// Within a longer one, nobody knows when the zoom changed.
constexpr Duration kLongestGap = std::chrono::seconds{1};
/// Zooms that differ by less are the same: fields of view are told in tenths of degrees.
constexpr double kSameFocalShare = 0.01;
/// What times of cameras are off by, 1-sigma: they tell how they were set, not how the frame was taken.
constexpr double kTimeSigma_s = 0.05;
/// A zoom that begins or ends to run between two samples is off by a third of what it changes there (RMS),
/// and between most it runs all the time.
constexpr double kBendShare = 0.125;
/// Links hold messages back for a while.
constexpr Duration kLateness = std::chrono::milliseconds{300};

double change_share(const Eigen::Vector2d& before_px, const Eigen::Vector2d& after_px) {
  return std::abs(after_px.x() - before_px.x()) / std::min(before_px.x(), after_px.x());
}

}  // namespace

bool ZoomHistory::add(VehicleTime time, const Eigen::Vector2d& focal_px) {
  if (!samples_.insert(time, focal_px)) return false;
  if (newest_ && time < *newest_) return true;
  spacing_ = newest_ ? time - *newest_ : Duration::zero();
  newest_ = time;
  last_ = focal_px;
  return true;
}

Expected<ZoomState, NoState> ZoomHistory::at(VehicleTime time) const {
  const auto around = samples_.bracket(time, Duration::max(), Duration::zero());
  if (!around) return ZoomState{around.error() == NoState::kTooOld ? samples_.oldest() : last_, 0.0};
  const double changed_share = change_share(around->before, around->after);
  if (around->spacing > kLongestGap && changed_share > kSameFocalShare) return NoState::kInAGap;
  const double spacing_s = seconds(around->spacing);
  const double per_second = spacing_s > 0.0 ? changed_share / spacing_s : 0.0;
  return ZoomState{around->interpolated(), std::hypot(kTimeSigma_s * per_second, kBendShare * changed_share)};
}

std::optional<VehicleTime> ZoomHistory::due_after(VehicleTime time) const {
  const bool is_regular = spacing_ > Duration::zero() && spacing_ <= kLongestGap;
  if (!newest_ || *newest_ >= time || !is_regular) return std::nullopt;
  return *newest_ + 2 * spacing_ + kLateness;
}

void ZoomHistory::restart() {
  samples_.clear();
  newest_.reset();
  spacing_ = Duration::zero();
}

}  // namespace geoloc
