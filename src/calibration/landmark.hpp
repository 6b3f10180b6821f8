// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "calibration/drift.hpp"
#include "geoloc/calibration/calibration.hpp"

namespace geoloc {

/// One look at an object, linearised: x = value + calibration_jacobian c + node_jacobian d(t) + noise, where
/// c is the calibration, d(t) the drift at the frame's time (a mean of the two nodes around it), x the
/// object's true position.
struct LandmarkObservation {
  Eigen::Vector2d value;
  Eigen::Matrix<double, 2, CalibrationIndex::kSize> calibration_jacobian;
  Eigen::Matrix<double, 2, kNodeSize> node_jacobian;
  NodeSpan span;
  Eigen::Matrix2d information;  ///< inverse covariance of the noise
};

/// All that an object's looks say, as sums that add up exactly (docs/method.md): with W the information, J
/// the Jacobian and y the value of a look,  A = sum W, b = sum W y, B = sum W J, C = sum J' W J, g = -sum J'
/// W y. J has columns for the calibration and for the nodes that were touched; nothing else is stored.
class Landmark {
 public:
  using CalibrationRow = Eigen::Matrix<double, 2, CalibrationIndex::kSize>;
  /// More nodes than an object is usually seen in; beyond, its oldest is frozen.
  static constexpr std::size_t kMaxNodes = 16;

  /// What ties the object to one drift node.
  struct NodeTerms {
    std::uint32_t number = 0;
    Eigen::Matrix<double, 2, kNodeSize> B = Eigen::Matrix<double, 2, kNodeSize>::Zero();
    Eigen::Matrix<double, CalibrationIndex::kSize, kNodeSize> C_calibration =
        Eigen::Matrix<double, CalibrationIndex::kSize, kNodeSize>::Zero();
    NodeMatrix C_own = NodeMatrix::Zero();
    NodeMatrix C_next = NodeMatrix::Zero();  ///< rows: this node, columns: the one after
    NodeVector g = NodeVector::Zero();
  };

  void add(const LandmarkObservation& observation, const DriftTimeline& drift);

  /// What is known of the object from elsewhere: a surveyed position.
  void add_prior(const Eigen::Vector2d& position_in_enu, const Eigen::Matrix2d& information);

  /// The looks of both are looks at one object.
  void merge(const Landmark& other, const DriftTimeline& drift);

  /// Takes the node's estimate as true from now on.
  void freeze(std::uint32_t node, const DriftTimeline& drift);

  /// x = A^-1 (b + B c + sum of B d over the nodes).
  Eigen::Vector2d position(const CalibrationVector& calibration, const DriftTimeline& drift) const;

  const Eigen::Matrix2d& A() const { return A_; }
  const Eigen::Vector2d& b() const { return b_; }
  const CalibrationRow& B() const { return B_; }
  const CalibrationMatrix& C() const { return C_; }
  const CalibrationVector& g() const { return g_; }
  const NodeTerms* begin() const { return nodes_.data(); }
  const NodeTerms* end() const { return nodes_.data() + node_count_; }

 private:
  NodeTerms& terms_of(std::uint32_t node, const DriftTimeline& drift);
  void drop_oldest(const NodeVector& value);

  Eigen::Matrix2d A_ = Eigen::Matrix2d::Zero();
  Eigen::Vector2d b_ = Eigen::Vector2d::Zero();
  CalibrationRow B_ = CalibrationRow::Zero();
  CalibrationMatrix C_ = CalibrationMatrix::Zero();
  CalibrationVector g_ = CalibrationVector::Zero();
  std::array<NodeTerms, kMaxNodes> nodes_{};  // ordered by number
  std::size_t node_count_ = 0;
};

}  // namespace geoloc
