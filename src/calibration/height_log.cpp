// SPDX-License-Identifier: Apache-2.0
#include "calibration/height_log.hpp"

#include <algorithm>

namespace geoloc {
namespace {

/// A rangefinder's scale is wrong by a share of the height, however long it measures: 0.2 m [1/m^2].
constexpr double kMostInformation = 25.0;

}  // namespace

void HeightLog::add(const NodeSpan& span, double value_m, double variance_m2) {
  const bool is_new = observations_.empty() || observations_.back().span.first != span.first;
  if (is_new && observations_.size() == observations_.capacity()) return;
  if (is_new) {
    observations_.push_back({span, value_m, 1.0 / variance_m2});
    readings_of_newest_ = 1;
    return;
  }
  HeightObservation& mean = observations_.back();
  const double share = 1.0 / ++readings_of_newest_;
  mean.span.weight_of_second += share * (span.weight_of_second - mean.span.weight_of_second);
  mean.value_m += share * (value_m - mean.value_m);
  mean.information += share * (1.0 / variance_m2 - mean.information);
}

/// Readings on both sides of the node become one, between the node before and the one after.
void HeightLog::thin(const ThinnedNode& node) {
  const double w = node.weight_of_next, deviation_m = node.deviation[kNodeUp];
  for (HeightObservation& seen : observations_) {
    const double second = seen.span.weight_of_second;
    if (seen.span.first == node.number) {
      seen.value_m -= (1.0 - second) * deviation_m;
      seen.span.weight_of_second = (1.0 - second) * w + second;
    } else if (seen.span.first + 1 == node.number) {
      seen.value_m -= second * deviation_m;
      seen.span.weight_of_second = second * w;
    }
    if (seen.span.first < node.number) ++seen.span.first;
  }
  const auto twin = std::adjacent_find(
      observations_.begin(), observations_.end(),
      [](const HeightObservation& a, const HeightObservation& b) { return a.span.first == b.span.first; });
  if (twin == observations_.end()) return;
  HeightObservation& mean = *twin;
  const HeightObservation& other = *(twin + 1);
  const double share = other.information / (mean.information + other.information);
  mean.span.weight_of_second += share * (other.span.weight_of_second - mean.span.weight_of_second);
  mean.value_m += share * (other.value_m - mean.value_m);
  mean.information += other.information;
  observations_.erase(twin + 1);
}

void HeightLog::freeze_oldest(const DriftTimeline& drift) {
  while (!observations_.empty() && observations_.front().span.first <= drift.begin()) {
    const HeightObservation& oldest = observations_.front();
    constant_.information += oldest.information;
    constant_.vector += oldest.information * (oldest.value_m - drift.at(oldest.span)[kNodeUp]);
    observations_.erase(observations_.begin());
  }
  const double excess = constant_.information / kMostInformation;
  if (!(excess > 1.0)) return;
  constant_.information /= excess;
  constant_.vector /= excess;
}

}  // namespace geoloc
