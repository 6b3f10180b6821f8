// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "calibration/node_history.hpp"
#include "calibration/sway.hpp"
#include "geoloc/calibration/drift_config.hpp"
#include "geoloc/geometry/time.hpp"

namespace geoloc {

/// A node's state: east, north, up [m], yaw [rad, clockwise]; corrections to what the vehicle reports.
inline constexpr int kNodeSize = 4;
inline constexpr int kNodeUp = 2;
using NodeVector = Eigen::Matrix<double, kNodeSize, 1>;
using NodeMatrix = Eigen::Matrix<double, kNodeSize, kNodeSize>;

/// The two nodes around a time, by their running numbers, and the weight of the second; the spell of the
/// sway.
struct NodeSpan {
  std::uint32_t first;
  double weight_of_second;
  std::uint32_t spell = kNoSpell;
};

struct DriftNode {
  VehicleTime time;
  std::uint32_t serial = 0;  ///< how many were made before it in the flight: unlike its number, it stays
  NodeVector mean = NodeVector::Zero();
  /// Prior given the node before: mean = transition .* (its mean), information of the rest. Of the oldest
  /// node kept, prior_mean stands for the node before.
  NodeVector transition = NodeVector::Zero();
  NodeVector information = NodeVector::Zero();
  NodeVector prior_mean = NodeVector::Zero();
  /// The same of the position's ripple, east and north alike, whose mean is zero.
  double ripple_transition = 0.0;
  double ripple_innovation = 0.0;  ///< its variance, given the ripple of the node before
  /// Variance that a step of the vehicle's state adds to the prior.
  NodeVector step_variance = NodeVector::Zero();

  bool is_after_step() const { return step_variance.maxCoeff() > 0.0; }
  /// Whether it continues the node before smoothly: there is no step between them, and no new clock.
  bool goes_on() const { return !is_after_step() && transition.maxCoeff() > 0.0; }
};

/// What takes the place of a node that is thinned out: d = (1 - w) d(before) + w d(after) + deviation.
struct ThinnedNode {
  std::uint32_t number;
  double weight_of_next;
  NodeVector deviation;  ///< as estimated
};

/// The nodes of the last minutes, numbered from 0 at the start of the flight.
class DriftTimeline {
 public:
  explicit DriftTimeline(const DriftConfig& config);
  /// geometry/room.hpp
  static std::size_t take_room(DriftTimeline* self, const DriftConfig& config);

  /// Nodes around `time`, made if need be. sigma_position_m: 1-sigma per axis of the wandering, as believed
  /// now. Times run forward; where one runs back (the vehicle rebooted) the drift begins anew.
  NodeSpan cover(VehicleTime time, double sigma_position_m);

  /// The same where the state has stepped since the last time: new nodes, that continue the ones before but
  /// for so much in each component.
  NodeSpan cover_after_step(VehicleTime time, double sigma_position_m, const NodeVector& step_variance);

  std::uint32_t begin() const { return begin_; }
  std::uint32_t end() const { return end_; }
  int size() const { return static_cast<int>(end_ - begin_); }

  const DriftNode& node(std::uint32_t number) const { return nodes_[slot(number)]; }
  DriftNode& node(std::uint32_t number) { return nodes_[slot(number)]; }

  /// The estimate at a time between two nodes.
  NodeVector at(const NodeSpan& span) const {
    return (1.0 - span.weight_of_second) * node(span.first).mean +
           span.weight_of_second * node(span.first + 1).mean;
  }

  /// Information of a node's prior, with the wandering of the position scaled as set.
  NodeVector information(std::uint32_t number) const {
    const double position = 1.0 / (position_scale_ * position_scale_);
    const NodeVector smooth = node(number).information.cwiseProduct(NodeVector(position, position, 1.0, 1.0));
    if (!node(number).is_after_step()) return smooth;
    return (smooth.cwiseInverse() + node(number).step_variance).cwiseInverse();
  }

  /// Variance of the position's ripple, given that of the node before.
  double ripple_variance(std::uint32_t number) const {
    return position_scale_ * position_scale_ * node(number).ripple_innovation;
  }

  /// Variance per axis, in the mean over the time between the two newest nodes, of what the position ripples
  /// by beside the straight line between them [m^2].
  double ripple_between_nodes_m2() const;

  /// A node's variance before anything was seen, were there no step of the state: the same at all times.
  NodeVector stationary_variance(std::uint32_t number) const;

  const DriftConfig& config() const { return config_; }

  /// How strongly the position wanders and ripples against what the receiver's accuracy let expect.
  double position_scale() const { return position_scale_; }
  void set_position_scale(double scale) { position_scale_ = scale; }

  /// A node that may be gone, by those that are left.
  NodeHistory::Blend resolve(std::uint32_t serial) const { return history_.resolve(serial); }

  /// How many nodes were made so far.
  std::uint32_t nodes_made() const { return history_.size(); }

  /// The number that a node which is left has now.
  std::uint32_t number_of(std::uint32_t serial) const;

  /// Errors that last for a second or so, beside the drift.
  const SwayTimeline& sway() const { return sway_; }
  SwayTimeline& sway() { return sway_; }

  /// Forgets all nodes: the drift begins anew.
  void clear() {
    begin_ = end_;
    sway_.clear();
  }

  /// The node that its neighbours can best stand for, for its age. nullopt where there is none but the
  /// newest, the oldest, and those at a step.
  std::optional<ThinnedNode> next_to_thin() const;

  /// Leaves out the node; those before it are called by a number higher by one from now on.
  void thin(const ThinnedNode& node);

  /// Nodes from here on are estimated, and have the number that they had when they were made.
  std::uint32_t begin_of_fine() const { return std::max(begin_, begin_of_fine_); }

  /// Forgets the oldest node: its estimate becomes the fixed start of what follows, as if all of it wandered.
  void freeze_oldest();

 private:
  std::size_t slot(std::uint32_t number) const { return number & (nodes_.size() - 1); }
  NodeSpan newest_span(VehicleTime time);
  void append(VehicleTime time, double sigma_position_m, bool continues);

  DriftConfig config_;
  std::vector<DriftNode> nodes_;  // a ring; its length is a power of two
  SwayTimeline sway_;
  NodeHistory history_;
  std::uint32_t begin_ = 0;
  std::uint32_t end_ = 0;
  std::uint32_t begin_of_fine_ = 0;
  double position_scale_ = 1.0;
};

}  // namespace geoloc
