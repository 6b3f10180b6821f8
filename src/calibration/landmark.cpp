// SPDX-License-Identifier: Apache-2.0
#include "calibration/landmark.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace geoloc {
namespace {

/// H' M, with H = [I, -slope].
template <int Columns>
Eigen::Matrix<double, kPointSize, Columns> by_point(const Eigen::Matrix<double, 2, Columns>& M,
                                                    const Eigen::Vector2d& slope) {
  Eigen::Matrix<double, kPointSize, Columns> product;
  product.template topRows<2>() = M;
  product.row(2) = -slope.x() * M.row(0) - slope.y() * M.row(1);
  return product;
}

}  // namespace

Landmark::NodeTerms& Landmark::terms_of(std::uint32_t node, const DriftTimeline& drift) {
  if (NodeTerms* const found = nodes_.find(node)) return *found;
  if (nodes_.is_full()) drop_oldest(drift.node(nodes_.begin()->number).mean);
  return nodes_.insert(node);
}

Landmark::SpellTerms& Landmark::terms_of_spell(std::uint32_t spell, std::uint32_t node,
                                               const DriftTimeline& drift) {
  if (SpellTerms* const found = spells_.find(spell)) return *found;
  if (spells_.is_full()) drop_oldest_spell(drift.sway().spell(spells_.begin()->number));
  SpellTerms& terms = spells_.insert(spell);
  terms.node = node;
  return terms;
}

void Landmark::add(const LandmarkObservation& observation, const DriftTimeline& drift) {
  const bool has_spell = observation.span.spell != kNoSpell;
  if (has_spell && drift.sway().is_frozen(observation.span.spell))
    return add(observation.given(drift.sway().spell(observation.span.spell)), drift);
  const Eigen::Matrix2d& W = observation.information;
  const Eigen::Vector2d& slope = observation.slope;
  const Eigen::Matrix<double, 2, CalibrationIndex::kSize>& Jc = observation.calibration_jacobian;
  const Eigen::Vector2d Wy = W * observation.value;
  const Eigen::Matrix<double, 2, CalibrationIndex::kSize> WJc = W * Jc;
  // lazyProduct: Eigen takes matrices of this size for large ones, and packs them first.
  const CalibrationMatrix JcWJc = Jc.transpose().lazyProduct(WJc);
  const CalibrationVector JcWy = Jc.transpose() * Wy;
  const Eigen::Matrix<double, 2, kPointSize> WH = W * observation.point_jacobian();
  A_ += by_point(WH, slope);
  b_ += by_point(Wy, slope);
  B_ += by_point(WJc, slope);
  C_ += JcWJc;
  g_ -= JcWy;

  const double second = observation.span.weight_of_second, first = 1.0 - second;
  const Eigen::Matrix<double, 2, kNodeSize>& Jd = observation.node_jacobian;
  const Eigen::Matrix<double, 2, kNodeSize> WJd = W * Jd;
  const NodeRows HWJd = by_point(WJd, slope);
  const Eigen::Matrix<double, CalibrationIndex::kSize, kNodeSize> JcWJd = Jc.transpose() * WJd;
  const NodeMatrix JdWJd = Jd.transpose() * WJd;
  const NodeVector JdWy = Jd.transpose() * Wy;
  const auto add_to = [&](std::uint32_t node, double weight) -> NodeTerms& {
    NodeTerms& terms = terms_of(node, drift);
    terms.B += weight * HWJd;
    terms.C_calibration += weight * JcWJd;
    terms.C_own += weight * weight * JdWJd;
    terms.g -= weight * JdWy;
    return terms;
  };
  // The second node first: making room for it must not drop the terms that the first reference points to.
  add_to(observation.span.first + 1, second);
  add_to(observation.span.first, first).C_next += first * second * JdWJd;
  if (!has_spell) return;

  SpellTerms& terms = terms_of_spell(observation.span.spell, observation.span.first, drift);
  // Js = [I, the first two columns of Jc].
  static_assert(CalibrationIndex::kBoresight == 0 && kSwaySize == 4);
  Eigen::Matrix<double, 2, kSwaySize> WJs;
  WJs.leftCols<2>() = W;
  WJs.rightCols<2>() = WJc.leftCols<2>();
  terms.B += by_point(WJs, slope);
  terms.C_calibration.leftCols<2>() += WJc.transpose();
  terms.C_calibration.rightCols<2>() += JcWJc.leftCols<2>();
  SpellTerms::NodeBlock JdWJs;
  JdWJs.leftCols<2>() = WJd.transpose();
  JdWJs.rightCols<2>() = JcWJd.topRows<2>().transpose();
  terms.C_node[0] += first * JdWJs;
  terms.C_node[1] += second * JdWJs;
  terms.C_own.topRows<2>() += WJs;
  terms.C_own.bottomLeftCorner<2, 2>() += WJc.leftCols<2>().transpose();
  terms.C_own.bottomRightCorner<2, 2>() += JcWJc.topLeftCorner<2, 2>();
  terms.g.head<2>() -= Wy;
  terms.g.tail<2>() -= JcWy.head<2>();
}

void Landmark::clear() {
  C_.setZero();
  g_.setZero();
  A_.setZero();
  b_.setZero();
  B_.setZero();
  nodes_.clear();
  spells_.clear();
}

void Landmark::restore(const PointMatrix& A, const Point& b, const CalibrationRows& B) {
  clear();
  A_ = A;
  b_ = b;
  B_ = B;
}

void Landmark::restore_node(std::uint32_t number, const NodeRows& B, const DriftTimeline& drift) {
  terms_of(number, drift).B += B;
}

void Landmark::restore_spell(std::uint32_t number, std::uint32_t node, const SpellRows& B,
                             const DriftTimeline& drift) {
  terms_of_spell(number, node, drift).B += B;
}

void Landmark::add_prior(const PointInformation& prior) {
  A_ += prior.matrix;
  b_ += prior.vector;
}

void Landmark::merge(const Landmark& other, const DriftTimeline& drift) {
  A_ += other.A_;
  b_ += other.b_;
  B_ += other.B_;
  C_ += other.C_;
  g_ += other.g_;
  for (const NodeTerms& theirs : other) {
    NodeTerms& ours = terms_of(theirs.number, drift);
    ours.B += theirs.B;
    ours.C_calibration += theirs.C_calibration;
    ours.C_own += theirs.C_own;
    ours.C_next += theirs.C_next;
    ours.g += theirs.g;
  }
  for (const SpellTerms& theirs : other.spells_) {
    if (drift.sway().is_frozen(theirs.number)) continue;
    SpellTerms& ours = terms_of_spell(theirs.number, theirs.node, drift);
    ours.B += theirs.B;
    ours.C_calibration += theirs.C_calibration;
    ours.C_node[0] += theirs.C_node[0];
    ours.C_node[1] += theirs.C_node[1];
    ours.C_own += theirs.C_own;
    ours.g += theirs.g;
  }
}

/// With J for a look's Jacobian by the node that goes, those by its neighbours grow by (1 - w) J and w J, and
/// the look's value by J times the deviation.
void Landmark::thin(const ThinnedNode& node, const DriftTimeline& drift) {
  // Where all places are taken there is none for two neighbours in place of one node.
  if (nodes_.is_full() && nodes_.find(node.number - 1) == nullptr && nodes_.find(node.number + 1) == nullptr)
    freeze(node.number, drift);
  if (NodeTerms* const found = nodes_.find(node.number)) {
    const NodeTerms gone = *found;
    const NodeTerms* const before = nodes_.find(node.number - 1);
    const NodeMatrix C_before = before == nullptr ? NodeMatrix::Zero() : before->C_next;
    const double second = node.weight_of_next, first = 1.0 - second;
    const NodeVector& e = node.deviation;
    const NodeVector g = gone.g - gone.C_own * e;
    b_ += gone.B * e;
    g_ -= gone.C_calibration * e;
    nodes_.erase(found);
    const auto add_to = [&](std::uint32_t number, double weight, const NodeMatrix& C_shared) -> NodeTerms& {
      NodeTerms& terms = terms_of(number, drift);
      terms.B += weight * gone.B;
      terms.C_calibration += weight * gone.C_calibration;
      terms.C_own += weight * (C_shared + C_shared.transpose()) + weight * weight * gone.C_own;
      terms.g += weight * g - C_shared * e;
      return terms;
    };
    add_to(node.number + 1, second, gone.C_next.transpose());
    add_to(node.number - 1, first, C_before).C_next =
        second * C_before + first * gone.C_next + first * second * gone.C_own;
  }
  for (NodeTerms& terms : nodes_) {
    if (terms.number < node.number) ++terms.number;
  }
}

void Landmark::freeze_spell(std::uint32_t spell, const DriftTimeline& drift) {
  if (!spells_.is_empty() && spells_.begin()->number == spell) drop_oldest_spell(drift.sway().spell(spell));
}

/// With f = k + l e for the spell and the focal length's logarithm.
void Landmark::drop_oldest_spell(const Spell& spell) {
  constexpr int kFocal = CalibrationIndex::kFocal;
  const SpellTerms& gone = *spells_.begin();
  const SwayVector k = spell.constant();
  const SwayVector& l = spell.per_focal;
  const CalibrationVector with_calibration = gone.C_calibration * l;
  b_ += gone.B * k;
  depend_on_focal(gone.B * l);
  g_ -= gone.C_calibration * k;
  g_[kFocal] += l.dot(gone.g - gone.C_own * k);
  C_.col(kFocal) += with_calibration;
  C_.row(kFocal) += with_calibration.transpose();
  C_(kFocal, kFocal) += l.dot(gone.C_own * l);
  for (std::uint32_t i = 0; i < 2; ++i) {
    NodeTerms* const node = nodes_.find(gone.node + i);
    if (node == nullptr) continue;
    node->g -= gone.C_node[i] * k;
    node->C_calibration.row(kFocal) += (gone.C_node[i] * l).transpose();
  }
  spells_.erase(spells_.begin());
}

void Landmark::freeze(std::uint32_t node, const DriftTimeline& drift) {
  if (!nodes_.is_empty() && nodes_.begin()->number == node) drop_oldest(drift.node(node).mean);
}

void Landmark::freeze_latency(double latency_s) {
  constexpr int kLatency = CalibrationIndex::kLatency;
  b_ += B_.col(kLatency) * latency_s;
  g_ -= C_.col(kLatency) * latency_s;
  B_.col(kLatency).setZero();
  C_.col(kLatency).setZero();
  C_.row(kLatency).setZero();
  g_[kLatency] = 0.0;
  const auto freeze_in = [latency_s](auto& all) {
    for (auto& terms : all) {
      terms.g -= terms.C_calibration.row(kLatency).transpose() * latency_s;
      terms.C_calibration.row(kLatency).setZero();
    }
  };
  freeze_in(nodes_);
  freeze_in(spells_);
}

void Landmark::drop_oldest(const NodeVector& value) {
  const NodeTerms& gone = *nodes_.begin();
  b_ += gone.B * value;
  g_ -= gone.C_calibration * value;
  if (NodeTerms* const next = nodes_.find(gone.number + 1)) next->g -= gone.C_next.transpose() * value;
  for (SpellTerms& terms : spells_) {
    for (std::uint32_t side = 0; side < 2; ++side) {
      if (terms.node + side != gone.number) continue;
      terms.g -= terms.C_node[side].transpose() * value;
      terms.C_node[side].setZero();
    }
  }
  nodes_.erase(nodes_.begin());
}

Point Landmark::weighted_position(const CalibrationVector& calibration, const DriftTimeline& drift) const {
  Point sum = b_ + B_ * calibration;
  for (const NodeTerms& terms : *this) sum += terms.B * drift.node(terms.number).mean;
  for (const SpellTerms& terms : spells_) sum += terms.B * drift.sway().spell(terms.number).mean;
  return sum;
}

}  // namespace geoloc
