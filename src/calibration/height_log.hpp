// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "calibration/drift.hpp"
#include "geometry/room.hpp"

namespace geoloc {

/// The camera was seen to be `value_m` higher above the level ground than reported: calibration's height plus
/// the drift's up component between two nodes.
struct HeightObservation {
  NodeSpan span;
  double value_m;
  double information;  ///< inverse variance [1/m^2]
};

/// What is known of the camera's height besides looks. Readings between the same two nodes are taken over the
/// same ground, whose roughness they share: they count as one observation, their mean, with the variance of
/// one. Never allocates after construction.
class HeightLog {
 public:
  /// What is left of observations whose nodes are frozen: of the constant height.
  struct Constant {
    double information = 0.0;
    double vector = 0.0;
  };

  /// Nothing is known, and nothing will be.
  HeightLog() = default;

  /// Room for so many nodes.
  explicit HeightLog(int max_nodes) { take_room(this, max_nodes); }
  /// geometry/room.hpp
  static std::size_t take_room(HeightLog* self, int max_nodes) {
    return room::reserve(self, &HeightLog::observations_, static_cast<std::size_t>(max_nodes) + 2);
  }

  /// `span`: that of the newest nodes.
  void add(const NodeSpan& span, double value_m, double variance_m2);

  /// The drift's oldest node is about to be frozen at its estimate.
  void freeze_oldest(const DriftTimeline& drift);

  /// The drift's node is about to be left out.
  void thin(const ThinnedNode& node);

  /// The flight begins anew.
  void clear() {
    observations_.clear();
    constant_ = {};
    readings_of_newest_ = 0;
  }

  const std::vector<HeightObservation>& observations() const { return observations_; }
  const Constant& constant() const { return constant_; }

 private:
  std::vector<HeightObservation> observations_;  // in order of their nodes
  int readings_of_newest_ = 0;
  Constant constant_;
};

}  // namespace geoloc
