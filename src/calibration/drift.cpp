// SPDX-License-Identifier: Apache-2.0
#include "calibration/drift.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geoloc/geometry/angles.hpp"
#include "geometry/room.hpp"

namespace geoloc {

DriftTimeline::DriftTimeline(const DriftConfig& config) : config_(config), sway_(config) {
  take_room(this, config);
}

std::size_t DriftTimeline::take_room(DriftTimeline* self, const DriftConfig& config) {
  std::size_t length = 1;
  while (length < static_cast<std::size_t>(config.max_nodes) + 2) length *= 2;
  return room::resize(self, &DriftTimeline::nodes_, length) + SwayTimeline::take_room(nullptr) +
         NodeHistory::take_room(nullptr);
}

NodeSpan DriftTimeline::cover(VehicleTime time, double sigma_position_m) {
  const Duration spacing = from_seconds(config_.node_spacing_s);
  const bool continues = size() >= 2 && time >= node(end_ - 2).time;
  if (!continues) {
    append(time, sigma_position_m, false);
    append(time + spacing, sigma_position_m, true);
  } else if (time > node(end_ - 1).time) {
    // After a pause the nodes go on from here: empty ones in between would say nothing.
    if (time - node(end_ - 1).time > spacing) append(time, sigma_position_m, true);
    append(node(end_ - 1).time + spacing, sigma_position_m, true);
  }
  return newest_span(time);
}

/// The new nodes begin a little earlier, so that times that run back a little find them.
NodeSpan DriftTimeline::cover_after_step(VehicleTime time, double sigma_position_m,
                                         const NodeVector& step_variance) {
  if (size() < 2) return cover(time, sigma_position_m);
  const Duration spacing = from_seconds(config_.node_spacing_s);
  append(time - spacing / 10, sigma_position_m, true);
  node(end_ - 1).step_variance = step_variance;
  append(node(end_ - 1).time + spacing, sigma_position_m, true);
  return newest_span(time);
}

/// With u the nodes' distance in units of the time constant and w the share of it that has passed, the mean
/// over w of the variance of r(w) - (1 - w) r(0) - w r(1), by the covariance exp(-u |w - w'|).
double DriftTimeline::ripple_between_nodes_m2() const {
  if (size() < 2) return 0.0;
  const DriftNode& newest = node(end_ - 1);
  const double kept = newest.ripple_transition;
  if (!(kept > 0.0 && kept < 1.0)) return 0.0;
  const double u = -std::log(kept);
  const double share = (5.0 + kept) / 3.0 - 4.0 * (u - 1.0 + kept) / (u * u);
  return share * ripple_variance(end_ - 1) / (1.0 - kept * kept);
}

NodeVector DriftTimeline::stationary_variance(std::uint32_t number) const {
  const DriftNode& node = this->node(number);
  const double squared_scale = position_scale_ * position_scale_;
  NodeVector variance =
      (node.information.array() * (1.0 - node.transition.array().square())).inverse().matrix();
  variance.head<2>() *= squared_scale;
  variance.head<2>().array() += ripple_variance(number) / (1.0 - std::pow(node.ripple_transition, 2));
  return variance;
}

NodeSpan DriftTimeline::newest_span(VehicleTime time) {
  const std::uint32_t first = end_ - 2;
  const Duration length = node(first + 1).time - node(first).time;
  const double share = seconds(time - node(first).time) / seconds(length);
  return {first, share, sway_.cover(time, first, share)};
}

void DriftTimeline::append(VehicleTime time, double sigma_position_m, bool continues) {
  DriftNode next;
  next.time = time;
  next.serial = history_.append();
  const double sigma_yaw = config_.sigma_yaw_deg * kRadPerDeg;
  const double sigma_wandering_m = std::sqrt(1.0 - config_.ripple_share) * sigma_position_m;
  const NodeVector sigma(sigma_wandering_m, sigma_wandering_m, config_.sigma_up_m, sigma_yaw);
  if (continues) {
    const double pause_s = std::abs(seconds(time - node(end_ - 1).time));
    const double position = std::exp(-pause_s / config_.position_time_constant_s);
    const double up = std::exp(-pause_s / config_.up_time_constant_s);
    const double yaw = std::exp(-pause_s / config_.yaw_time_constant_s);
    next.transition = NodeVector(position, position, up, yaw);
    next.ripple_transition = std::exp(-pause_s / config_.ripple_time_constant_s);
    next.mean = next.transition.cwiseProduct(node(end_ - 1).mean);
  }
  next.information = (sigma.array().square() * (1.0 - next.transition.array().square())).inverse();
  next.ripple_innovation = config_.ripple_share * sigma_position_m * sigma_position_m *
                           (1.0 - next.ripple_transition * next.ripple_transition);
  nodes_[slot(end_)] = next;
  ++end_;
}

/// Serial numbers rise with the nodes' numbers.
std::uint32_t DriftTimeline::number_of(std::uint32_t serial) const {
  std::uint32_t first = begin_, last = end_;
  while (last - first > 1) {
    const std::uint32_t middle = first + (last - first) / 2;
    (node(middle).serial <= serial ? first : last) = middle;
  }
  return first;
}

/// The one whose neighbours are nearest to each other for their age, so that the nodes' distance grows with
/// it. A straight line across a step of the state, or from one clock to another, would say nothing of the
/// node.
std::optional<ThinnedNode> DriftTimeline::next_to_thin() const {
  std::optional<std::uint32_t> densest;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t number = begin_ + 1; number + 2 < end_; ++number) {
    const DriftNode &before = node(number - 1), &after = node(number + 1);
    if (!node(number).goes_on() || !after.goes_on()) continue;
    const double per_age = seconds(after.time - before.time) / seconds(node(end_ - 1).time - after.time);
    if (!(per_age < least)) continue;
    least = per_age;
    densest = number;
  }
  if (!densest) return std::nullopt;
  const DriftNode &before = node(*densest - 1), &here = node(*densest), &after = node(*densest + 1);
  const double weight = seconds(here.time - before.time) / seconds(after.time - before.time);
  return ThinnedNode{*densest, weight, here.mean - (1.0 - weight) * before.mean - weight * after.mean};
}

void DriftTimeline::thin(const ThinnedNode& thinned) {
  const DriftNode& gone = node(thinned.number);
  DriftNode& after = node(thinned.number + 1);
  const double second = thinned.weight_of_next;
  history_.replace(gone.serial, {{NodeHistory::Share{node(thinned.number - 1).serial, 1.0 - second},
                                  NodeHistory::Share{after.serial, second}},
                                 thinned.deviation});
  const NodeVector variance =
      after.information.cwiseInverse() + after.transition.cwiseAbs2().cwiseQuotient(gone.information);
  after.information = variance.cwiseInverse();
  after.transition = after.transition.cwiseProduct(gone.transition);
  after.ripple_innovation += std::pow(after.ripple_transition, 2) * gone.ripple_innovation;
  after.ripple_transition *= gone.ripple_transition;
  for (std::uint32_t number = thinned.number; number > begin_; --number) node(number) = node(number - 1);
  ++begin_;
  begin_of_fine_ = std::max(begin_of_fine_, thinned.number + 1);
}

void DriftTimeline::freeze_oldest() {
  const DriftNode& oldest = node(begin_);
  history_.replace(oldest.serial, {{}, oldest.mean});
  DriftNode& heir = node(begin_ + 1);
  heir.prior_mean = heir.transition.cwiseProduct(oldest.mean);
  heir.transition.setZero();
  heir.ripple_transition = 0.0;
  ++begin_;
}

}  // namespace geoloc
