// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "geoloc/calibration/drift_config.hpp"
#include "geoloc/geometry/time.hpp"

namespace geoloc {

/// The sway: what position and attitude are off by for a second or so, as a correction to what the vehicle
/// reports. East, north [m]; turn of the camera about its own axes [rad].
inline constexpr int kSwaySize = 4;
using SwayVector = Eigen::Matrix<double, kSwaySize, 1>;
using SwayMatrix = Eigen::Matrix<double, kSwaySize, kSwaySize>;

/// Stands for "no spell": the sway is not estimated.
inline constexpr std::uint32_t kNoSpell = std::numeric_limits<std::uint32_t>::max();

/// A time for which the sway is taken to be constant. It lies between two neighbouring nodes of the drift.
struct Spell {
  VehicleTime begin;
  std::uint32_t node = 0;  ///< of the drift, the one before
  int part = 0;            ///< of the time between the two nodes
  SwayVector mean = SwayVector::Zero();
  /// What the estimate changes by with the logarithm of the focal length, where that is an unknown, and the
  /// one that `mean` belongs to. What is frozen goes on to depend on it: held at `mean`, it would vouch for
  /// that focal length.
  SwayVector per_focal = SwayVector::Zero();
  double focal = 0.0;
  /// Prior given the spell before: mean = transition * (its mean), variance = innovation_share * that of the
  /// sway. Of the oldest spell estimated, prior_mean and prior_per_focal stand for the spell before, as
  /// constant() and per_focal.
  double transition = 0.0;
  double innovation_share = 1.0;
  SwayVector prior_mean = SwayVector::Zero();
  SwayVector prior_per_focal = SwayVector::Zero();

  SwayVector at(double focal_logarithm) const { return mean + (focal_logarithm - focal) * per_focal; }
  /// At the nominal focal length.
  SwayVector constant() const { return at(0.0); }
};

/// What is known of the focal length's logarithm by itself, in information form.
struct FocalInformation {
  double information = 0.0;
  double vector = 0.0;
};

/// The spells of the last seconds, numbered from 0 at the start of the flight. Never allocates after
/// construction.
class SwayTimeline {
 public:
  explicit SwayTimeline(const DriftConfig& config);
  /// geometry/room.hpp
  static std::size_t take_room(SwayTimeline* self);

  /// The spell of a time that lies between the node and the next, by a share of their distance; made if need
  /// be. Nodes and times run forward. kNoSpell where none are wanted.
  std::uint32_t cover(VehicleTime time, std::uint32_t node, double share);

  /// Those that are estimated: older ones are frozen.
  std::uint32_t begin() const { return begin_; }
  std::uint32_t end() const { return end_; }
  int size() const { return static_cast<int>(end_ - begin_); }
  bool is_full() const { return size() > max_spells_; }

  /// Frozen ones remain for a while.
  const Spell& spell(std::uint32_t number) const { return spells_[slot(number)]; }
  Spell& spell(std::uint32_t number) { return spells_[slot(number)]; }

  /// Whether looks of that time are off by what is known, or taken to be.
  bool is_frozen(std::uint32_t number) const { return number < begin_; }

  /// Variances of a component, for all times.
  const SwayVector& variance() const { return variance_; }
  void set_variance(double position_m2, double turn_rad2) {
    variance_ << position_m2, position_m2, turn_rad2, turn_rad2;
  }

  /// Information of a spell's prior, given the one before.
  SwayVector information(std::uint32_t number) const {
    return (spell(number).innovation_share * variance_.array().max(kLeastVariance)).inverse();
  }

  /// By the priors of the spells that are frozen.
  const FocalInformation& of_focal() const { return of_focal_; }

  void clear() {
    begin_ = end_;
    of_focal_ = {};
  }

  /// The oldest spell's estimate becomes the start of what follows.
  void freeze_oldest();

 private:
  static constexpr double kLeastVariance = 1e-12;
  std::size_t slot(std::uint32_t number) const { return number & (spells_.size() - 1); }

  int parts_between_nodes_;
  int max_spells_;
  double time_constant_s_;
  SwayVector variance_ = SwayVector::Zero();
  std::vector<Spell> spells_;  // a ring; its length is a power of two
  FocalInformation of_focal_;
  std::uint32_t begin_ = 0;
  std::uint32_t end_ = 0;
};

}  // namespace geoloc
