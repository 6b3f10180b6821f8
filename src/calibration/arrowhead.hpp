// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "calibration/drift.hpp"
#include "calibration/envelope_cholesky.hpp"
#include "calibration/height_log.hpp"
#include "calibration/landmark.hpp"
#include "calibration/position_prior.hpp"
#include "geoloc/calibration/calibration.hpp"

namespace geoloc {

class SettledSums;

/// Where the unknowns of the head stand: the spells of the sway, the nodes of the drift from the oldest on,
/// the calibration. What objects tie together lies near the diagonal then, but for the calibration's rows,
/// which come last and fill nothing; the spells concern the objects in view alone.
struct HeadLayout {
  std::uint32_t begin = 0;            ///< numbers of the nodes: oldest,
  std::uint32_t end = 0;              ///< and one past the newest
  std::uint32_t begin_of_spells = 0;  ///< the same of the spells
  std::uint32_t end_of_spells = 0;

  Eigen::Index column_of_spell(std::uint32_t spell) const {
    return kSwaySize * static_cast<Eigen::Index>(spell - begin_of_spells);
  }
  Eigen::Index column_of(std::uint32_t node) const {
    return column_of_spell(end_of_spells) + kNodeSize * static_cast<Eigen::Index>(node - begin);
  }
  bool has_node(std::uint32_t node) const { return node >= begin && node < end; }
  Eigen::Index column_of_calibration() const { return column_of(end); }
  Eigen::Index size() const { return column_of_calibration() + CalibrationIndex::kSize; }
};

/// What is believed of the latency since a clock stepped.
struct LatencyPrior {
  double latency_s;
  double sigma_s;
};

/// The part of the calibration's prior that depends on the flight.
struct FlightPrior {
  double height_m;
  double sigma_height_m;
  double sigma_offset_m;  ///< 1-sigma per axis of the vehicle's constant position error
  std::optional<LatencyPrior> latency = std::nullopt;  ///< in place of the camera's, where it is another
};

/// Least squares over everything seen so far: calibration and drift (the head) and all objects (the arrow's
/// shaft), which are eliminated one by one because no look joins two of them. Exact up to linearisation
/// (docs/method.md).
class ArrowheadSolver {
 public:
  /// What the head was found to be, with all covariances that follow from it. It reads the solver's factor
  /// and is valid until the next solve().
  class Solution {
   public:
    Calibration calibration() const;

    /// Mean of a node, by its running number.
    NodeVector node(std::uint32_t number) const;
    NodeMatrix newest_node_covariance() const;
    /// Mean of a spell of the sway, by its running number.
    SwayVector spell(std::uint32_t number) const;
    /// What it changes by with the focal length's logarithm e: cov(spell, e) / var(e). Zero where the focal
    /// length is known.
    SwayVector spell_per_focal(std::uint32_t number) const;

    /// Covariance of an object's absolute position [m^2]: its own noise and that of the head. Its height is
    /// that above the reported home, so that the calibration's height is part of it.
    PointMatrix covariance(const Landmark& landmark) const;

    /// Covariance of the difference of two objects' positions [m^2]: what they share cancels.
    PointMatrix covariance_of_difference(const Landmark& a, const Landmark& b) const;

    /// The head's part of covariance() as a root, L L' [m], with a column for each of size_of_head()
    /// independent errors of variance one. They are the same for all objects: L_a L_b' is the covariance
    /// between two.
    EnvelopeCholesky::Rows shared_error(const Landmark& landmark) const;
    Eigen::Index size_of_head() const { return layout_.size(); }
    /// The same of a component of the calibration, and of one of a node.
    Eigen::RowVectorXd shared_error_of_calibration(int index) const;
    Eigen::RowVectorXd shared_error_of_node(std::uint32_t number, int component) const;

    /// How strongly the position was seen to wander, in units of what the nodes' prior says: one step of
    /// expectation maximisation. `drift` holds this solution's means, and the scale that it was found with.
    /// nullopt while there are too few nodes to tell. Costs as much as a solution.
    std::optional<double> observed_wandering(const DriftTimeline& drift) const;

   private:
    friend class ArrowheadSolver;
    double sum_of_steps(const DriftTimeline& drift, int component) const;
    void gather_sensitivity(const Landmark& landmark) const;
    Eigen::RowVectorXd shared_error_of(Eigen::Index column) const;
    Solution(ArrowheadSolver& solver, const HeadLayout& layout);

    ArrowheadSolver* solver_;
    HeadLayout layout_;
    Eigen::Matrix<double, kNodeSize + CalibrationIndex::kSize, kNodeSize + CalibrationIndex::kSize>
        newest_covariance_;  // of the newest node and the calibration
  };

  /// Room for as many nodes and spells as `drift` allows.
  ArrowheadSolver(const CalibrationPrior& prior, const DriftConfig& drift);
  /// geometry/room.hpp
  static std::size_t take_room(ArrowheadSolver* self, const DriftConfig& drift);

  /// Solves for the head with the objects' sums. nullopt where rounding has left no solution.
  /// `heights`: what is known of the camera's height besides. `settled`: what objects tell that are not among
  /// the landmarks; nullptr: there are none.
  [[nodiscard]] std::optional<Solution> solve(const std::vector<const Landmark*>& landmarks,
                                              const FlightPrior& prior, const DriftTimeline& drift,
                                              const HeightLog& heights = HeightLog(),
                                              const SettledSums* settled = nullptr);

  /// The calibration before anything was seen.
  Calibration prior(const FlightPrior& prior) const;

 private:
  bool is_focal_unknown() const { return prior_sigma_[CalibrationIndex::kFocal] > 0.0; }
  void add_prior(const Calibration& prior, const DriftTimeline& drift, const HeadLayout& layout);
  void add_prior_of_position(const DriftTimeline& drift, const HeadLayout& layout);
  void add_prior_of_sway(const SwayTimeline& sway, const HeadLayout& layout);
  void add_frozen_sway(const SwayTimeline& sway, const HeadLayout& layout);
  void add_heights(const HeightLog& heights, const HeadLayout& layout);
  void find_covariances_of_focal(const HeadLayout& layout);
  void add_landmark(const Landmark& landmark, const HeadLayout& layout);
  void add_own(const Landmark& landmark, const HeadLayout& layout);
  void spread(const Landmark& landmark, const HeadLayout& layout);
  void eliminate(const PointMatrix& A, const Point& b);
  void add_sensitivity(const Landmark& landmark, const HeadLayout& layout, double sign);
  PointMatrix head_covariance(Eigen::Index first);

  /// Columns of the head that follow each other.
  struct Run {
    Eigen::Index begin;
    Eigen::Index end;
  };

  CalibrationVector prior_mean_;
  CalibrationVector prior_sigma_;         // of all but the height and the offset
  PositionPrior position_prior_;          // scratch
  EnvelopeCholesky information_;          // S, and its factor after solve()
  Eigen::VectorXd right_hand_side_;       // h, and the head after solve()
  Eigen::VectorXd covariances_of_focal_;  // with the head, after solve(), where it is an unknown
  EnvelopeCholesky::Rows sensitivities_;  // scratch: dx/d(head)
  // Scratch of add_landmark(): an object's B and A^-1 B in the head's columns, in those that it has only.
  EnvelopeCholesky::Rows B_;
  EnvelopeCholesky::Rows gain_;
  std::vector<Run> runs_;
};

}  // namespace geoloc
