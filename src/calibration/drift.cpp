// SPDX-License-Identifier: Apache-2.0
#include "calibration/drift.hpp"

#include <cmath>

#include "geoloc/geometry/angles.hpp"

namespace geoloc {

DriftTimeline::DriftTimeline(const DriftConfig& config) : config_(config) {
  std::size_t length = 1;
  while (length < static_cast<std::size_t>(config.max_nodes) + 2) length *= 2;
  nodes_.resize(length);
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

NodeSpan DriftTimeline::newest_span(VehicleTime time) const {
  const std::uint32_t first = end_ - 2;
  const Duration length = node(first + 1).time - node(first).time;
  return {first, seconds(time - node(first).time) / seconds(length)};
}

void DriftTimeline::append(VehicleTime time, double sigma_position_m, bool continues) {
  DriftNode next;
  next.time = time;
  const double sigma_yaw = config_.sigma_yaw_deg * kRadPerDeg;
  const NodeVector sigma(sigma_position_m, sigma_position_m, config_.sigma_up_m, sigma_yaw);
  if (continues) {
    const double pause_s = std::abs(seconds(time - node(end_ - 1).time));
    const double position = std::exp(-pause_s / config_.position_time_constant_s);
    const double up = std::exp(-pause_s / config_.up_time_constant_s);
    const double yaw = std::exp(-pause_s / config_.yaw_time_constant_s);
    next.transition = NodeVector(position, position, up, yaw);
    next.mean = next.transition.cwiseProduct(node(end_ - 1).mean);
  }
  next.information = (sigma.array().square() * (1.0 - next.transition.array().square())).inverse();
  nodes_[slot(end_)] = next;
  ++end_;
}

void DriftTimeline::freeze_oldest() {
  const DriftNode& oldest = node(begin_);
  DriftNode& heir = node(begin_ + 1);
  heir.prior_mean = heir.transition.cwiseProduct(oldest.mean);
  heir.transition.setZero();
  ++begin_;
}

}  // namespace geoloc
