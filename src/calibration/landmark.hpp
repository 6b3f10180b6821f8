// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "calibration/drift.hpp"
#include "calibration/numbered_terms.hpp"
#include "geoloc/calibration/calibration.hpp"

namespace geoloc {

/// East, north, up [m].
inline constexpr int kPointSize = 3;
using Point = Eigen::Matrix<double, kPointSize, 1>;
using PointMatrix = Eigen::Matrix<double, kPointSize, kPointSize>;

/// What is known of a point by itself, in information form: matrix = covariance^-1 [1/m^2], vector = matrix *
/// mean [1/m]. Adds up where it is independent.
struct PointInformation {
  PointMatrix matrix = PointMatrix::Zero();
  Point vector = Point::Zero();

  PointInformation& operator+=(const PointInformation& other) {
    matrix += other.matrix;
    vector += other.vector;
    return *this;
  }
  PointInformation operator-() const { return {-matrix, -vector}; }
};

/// One look at an object, linearised: H x = value + calibration_jacobian c + node_jacobian d(t) + noise,
/// where x is the object's true position, c the calibration, d(t) the drift at the frame's time (a mean of
/// the two nodes around it). H = [1 0 -s_e; 0 1 -s_n]: along its ray, a look moves by s = (s_e, s_n) per
/// metre up.
struct LandmarkObservation {
  Eigen::Vector2d value;
  Eigen::Vector2d slope;  ///< s: east, north per up
  Eigen::Matrix<double, 2, CalibrationIndex::kSize> calibration_jacobian;
  Eigen::Matrix<double, 2, kNodeSize> node_jacobian;
  NodeSpan span;
  Eigen::Matrix2d information;  ///< inverse covariance of the noise

  /// By the sway: east and north as the vehicle, turned as the camera.
  Eigen::Matrix<double, 2, kSwaySize> sway_jacobian() const {
    Eigen::Matrix<double, 2, kSwaySize> jacobian;
    jacobian << Eigen::Matrix2d::Identity(), calibration_jacobian.middleCols<2>(CalibrationIndex::kBoresight);
    return jacobian;
  }

  /// The same look where the sway is known, or depends on nothing but the calibration.
  LandmarkObservation given(const Spell& sway) const {
    LandmarkObservation observation = *this;
    observation.value += sway_jacobian() * sway.constant();
    observation.calibration_jacobian.col(CalibrationIndex::kFocal) += sway_jacobian() * sway.per_focal;
    observation.span.spell = kNoSpell;
    return observation;
  }

  /// What H x is by this look alone.
  Eigen::Vector2d seen(const CalibrationVector& calibration, const DriftTimeline& drift) const {
    Eigen::Vector2d seen = value + calibration_jacobian * calibration + node_jacobian * drift.at(span);
    if (span.spell != kNoSpell)
      seen += sway_jacobian() * drift.sway().spell(span.spell).at(calibration[CalibrationIndex::kFocal]);
    return seen;
  }

  /// What it adds to an object's A x (Landmark::weighted_position).
  Point weighted_position(const CalibrationVector& calibration, const DriftTimeline& drift) const {
    return point_jacobian().transpose() * (information * seen(calibration, drift));
  }

  /// H.
  Eigen::Matrix<double, 2, kPointSize> point_jacobian() const {
    Eigen::Matrix<double, 2, kPointSize> jacobian;
    jacobian << Eigen::Matrix2d::Identity(), -slope;
    return jacobian;
  }
};

/// All that an object's looks say, as sums that add up exactly (docs/method.md): with W the information, H
/// and J the Jacobians by object and head, y the value of a look,  A = sum H' W H, b = sum H' W y, B = sum H'
/// W J, C = sum J' W J, g = -sum J' W y. J has columns for the calibration and for the nodes that were
/// touched; nothing else is stored.
class Landmark {
 public:
  using CalibrationRows = Eigen::Matrix<double, kPointSize, CalibrationIndex::kSize>;
  using NodeRows = Eigen::Matrix<double, kPointSize, kNodeSize>;
  using SpellRows = Eigen::Matrix<double, kPointSize, kSwaySize>;
  /// No fewer than the drift keeps by default (DriftConfig::max_nodes): beyond, the oldest is frozen, and
  /// what the object was off by then is taken for certain.
  static constexpr std::size_t kMaxNodes = 30;

  /// What ties the object to one drift node.
  struct NodeTerms {
    std::uint32_t number = 0;
    NodeRows B = NodeRows::Zero();
    Eigen::Matrix<double, CalibrationIndex::kSize, kNodeSize> C_calibration =
        Eigen::Matrix<double, CalibrationIndex::kSize, kNodeSize>::Zero();
    NodeMatrix C_own = NodeMatrix::Zero();
    NodeMatrix C_next = NodeMatrix::Zero();  ///< rows: this node, columns: the one after
    NodeVector g = NodeVector::Zero();
  };

  /// What ties the object to one spell of the sway.
  struct SpellTerms {
    std::uint32_t number = 0;
    std::uint32_t node = 0;  ///< of the drift, the one before
    SpellRows B = SpellRows::Zero();
    Eigen::Matrix<double, CalibrationIndex::kSize, kSwaySize> C_calibration =
        Eigen::Matrix<double, CalibrationIndex::kSize, kSwaySize>::Zero();
    using NodeBlock = Eigen::Matrix<double, kNodeSize, kSwaySize>;
    std::array<NodeBlock, 2> C_node = {NodeBlock::Zero(), NodeBlock::Zero()};  ///< the one before, and after
    SwayMatrix C_own = SwayMatrix::Zero();
    SwayVector g = SwayVector::Zero();
  };
  /// As many as may be estimated.
  static constexpr std::size_t kMaxSpells = 8;

  void add(const LandmarkObservation& observation, const DriftTimeline& drift);

  /// Sums that were told apart from C and g: A, b, B, and B of nodes and spells one by one. A spell lies
  /// behind `node`.
  void restore(const PointMatrix& A, const Point& b, const CalibrationRows& B);
  void restore_node(std::uint32_t number, const NodeRows& B, const DriftTimeline& drift);
  void restore_spell(std::uint32_t number, std::uint32_t node, const SpellRows& B,
                     const DriftTimeline& drift);

  /// A x moves by so much with the focal length's logarithm, besides.
  void depend_on_focal(const Point& per_focal) { B_.col(CalibrationIndex::kFocal) += per_focal; }

  /// Nothing is known. As Landmark{}, without writing where nothing will be read.
  void clear();

  /// What is known of the object from elsewhere: a surveyed position, the height of the ground.
  void add_prior(const PointInformation& prior);

  /// The looks of both are looks at one object.
  void merge(const Landmark& other, const DriftTimeline& drift);

  /// Takes the node's estimate as true from now on.
  void freeze(std::uint32_t node, const DriftTimeline& drift);

  /// Puts the nodes before and after in place of one between them; those before it are called by a number
  /// higher by one from now on.
  void thin(const ThinnedNode& node, const DriftTimeline& drift);

  /// Takes the spell's estimate as true from now on, as far as it does not depend on the focal length.
  void freeze_spell(std::uint32_t spell, const DriftTimeline& drift);

  /// Takes the latency of all looks so far as known: those to come are of another.
  void freeze_latency(double latency_s);

  /// A x = b + B c + sum of B d over the nodes and the spells.
  Point weighted_position(const CalibrationVector& calibration, const DriftTimeline& drift) const;

  const PointMatrix& A() const { return A_; }
  const Point& b() const { return b_; }
  const CalibrationRows& B() const { return B_; }
  const CalibrationMatrix& C() const { return C_; }
  const CalibrationVector& g() const { return g_; }
  const NodeTerms* begin() const { return nodes_.begin(); }
  const NodeTerms* end() const { return nodes_.end(); }
  const NumberedTerms<SpellTerms, kMaxSpells>& spells() const { return spells_; }

 private:
  NodeTerms& terms_of(std::uint32_t node, const DriftTimeline& drift);
  void drop_oldest(const NodeVector& value);
  SpellTerms& terms_of_spell(std::uint32_t spell, std::uint32_t node, const DriftTimeline& drift);
  void drop_oldest_spell(const Spell& spell);

  PointMatrix A_ = PointMatrix::Zero();
  Point b_ = Point::Zero();
  CalibrationRows B_ = CalibrationRows::Zero();
  CalibrationMatrix C_ = CalibrationMatrix::Zero();
  CalibrationVector g_ = CalibrationVector::Zero();
  NumberedTerms<NodeTerms, kMaxNodes> nodes_;
  NumberedTerms<SpellTerms, kMaxSpells> spells_;
};

}  // namespace geoloc
