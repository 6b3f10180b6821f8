// SPDX-License-Identifier: Apache-2.0
#include "calibration/landmark.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace geoloc {

Landmark::NodeTerms& Landmark::terms_of(std::uint32_t node, const DriftTimeline& drift) {
  const auto by_number = [](const NodeTerms& terms, std::uint32_t number) { return terms.number < number; };
  auto place = std::lower_bound(nodes_.begin(), nodes_.begin() + static_cast<std::ptrdiff_t>(node_count_),
                                node, by_number);
  if (place != nodes_.begin() + static_cast<std::ptrdiff_t>(node_count_) && place->number == node)
    return *place;
  if (node_count_ == kMaxNodes) {
    drop_oldest(drift.node(nodes_[0].number).mean);
    return terms_of(node, drift);
  }
  std::move_backward(place, nodes_.begin() + static_cast<std::ptrdiff_t>(node_count_),
                     nodes_.begin() + static_cast<std::ptrdiff_t>(node_count_ + 1));
  ++node_count_;
  *place = NodeTerms{};
  place->number = node;
  return *place;
}

void Landmark::add(const LandmarkObservation& observation, const DriftTimeline& drift) {
  const Eigen::Matrix2d& W = observation.information;
  const Eigen::Matrix<double, 2, kPointSize> H = observation.point_jacobian();
  const Eigen::Matrix<double, 2, CalibrationIndex::kSize>& Jc = observation.calibration_jacobian;
  const Eigen::Vector2d Wy = W * observation.value;
  const Eigen::Matrix<double, 2, CalibrationIndex::kSize> WJc = W * Jc;
  A_ += H.transpose() * W * H;
  b_ += H.transpose() * Wy;
  B_ += H.transpose() * WJc;
  C_ += Jc.transpose() * WJc;
  g_ -= Jc.transpose() * Wy;

  const double second = observation.span.weight_of_second, first = 1.0 - second;
  const Eigen::Matrix<double, 2, kNodeSize>& Jd = observation.node_jacobian;
  const Eigen::Matrix<double, 2, kNodeSize> WJd = W * Jd;
  const NodeRows HWJd = H.transpose() * WJd;
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
}

void Landmark::freeze(std::uint32_t node, const DriftTimeline& drift) {
  if (node_count_ > 0 && nodes_[0].number == node) drop_oldest(drift.node(node).mean);
}

void Landmark::freeze_latency(double latency_s) {
  constexpr int kLatency = CalibrationIndex::kLatency;
  b_ += B_.col(kLatency) * latency_s;
  g_ -= C_.col(kLatency) * latency_s;
  B_.col(kLatency).setZero();
  C_.col(kLatency).setZero();
  C_.row(kLatency).setZero();
  g_[kLatency] = 0.0;
  for (std::size_t i = 0; i < node_count_; ++i) {
    NodeTerms& terms = nodes_[i];
    terms.g -= terms.C_calibration.row(kLatency).transpose() * latency_s;
    terms.C_calibration.row(kLatency).setZero();
  }
}

void Landmark::drop_oldest(const NodeVector& value) {
  const NodeTerms& gone = nodes_[0];
  b_ += gone.B * value;
  g_ -= gone.C_calibration * value;
  if (node_count_ > 1 && nodes_[1].number == gone.number + 1) nodes_[1].g -= gone.C_next.transpose() * value;
  std::move(nodes_.begin() + 1, nodes_.begin() + static_cast<std::ptrdiff_t>(node_count_), nodes_.begin());
  --node_count_;
}

Point Landmark::position(const CalibrationVector& calibration, const DriftTimeline& drift) const {
  Point sum = b_ + B_ * calibration;
  for (const NodeTerms& terms : *this) sum += terms.B * drift.node(terms.number).mean;
  return A_.inverse() * sum;
}

}  // namespace geoloc
