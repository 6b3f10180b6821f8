// SPDX-License-Identifier: Apache-2.0
#include "calibration/settled_sums.hpp"

#include <Eigen/LU>
#include <numeric>

#include "geometry/room.hpp"

namespace geoloc {
namespace {

constexpr int kOfCalibration = CalibrationIndex::kSize;

/// One more of each than are kept, while the newest is begun before the oldest is left out.
std::size_t most_places(const DriftConfig& drift) {
  return static_cast<std::size_t>(drift.max_nodes + drift.max_spells) + 12;
}

}  // namespace

SettledSums::SettledSums(const DriftConfig& drift) {
  take_room(this, drift);
  B_.setZero();
  clear();
}

std::size_t SettledSums::take_room(SettledSums* self, const DriftConfig& drift) {
  const std::size_t places = most_places(drift);
  const auto blocks = static_cast<Eigen::Index>(places);
  const Eigen::Index size = offset(static_cast<int>(places));
  return room::resize(self, &SettledSums::matrix_, size, size) +
         room::resize(self, &SettledSums::vector_, size) +
         room::resize(self, &SettledSums::are_coupled_, blocks, blocks) +
         room::reserve(room::part(self, &SettledSums::nodes_), &Places::places, places) +
         room::reserve(room::part(self, &SettledSums::spells_), &Places::places, places) +
         room::reserve(self, &SettledSums::free_, places) +
         room::reserve(self, &SettledSums::columns_, places) +
         room::resize(self, &SettledSums::B_, kPointSize, size) +
         room::reserve(self, &SettledSums::places_of_B_, places);
}

void SettledSums::clear() {
  matrix_.setZero();
  vector_.setZero();
  are_coupled_.setConstant(false);
  nodes_.places.clear();
  spells_.places.clear();
  free_.resize(static_cast<std::size_t>(are_coupled_.rows()));
  std::iota(free_.rbegin(), free_.rend(), 0);
  is_empty_ = true;
}

/// Where nothing is settled yet, numbers begin with the first one that is.
int SettledSums::place_of(Places& of, std::uint32_t number) {
  if (of.places.empty()) of.begin = number;
  while (number < of.begin) {
    of.places.insert(of.places.begin(), free_.back());
    free_.pop_back();
    --of.begin;
  }
  while (number >= of.end()) {
    of.places.push_back(free_.back());
    free_.pop_back();
  }
  return of.of(number);
}

void SettledSums::couple(int a, int b) {
  are_coupled_(a, b) = are_coupled_(b, a) = true;
}

void SettledSums::settle(const Landmark& landmark) {
  is_empty_ = false;
  add_own(landmark);
  add_eliminated(landmark, 1.0);
}

void SettledSums::restore(const Landmark& landmark) {
  add_eliminated(landmark, -1.0);
}

/// - B' A^-1 B and B' A^-1 b.
void SettledSums::add_eliminated(const Landmark& landmark, double sign) {
  places_of_B_.clear();
  B_.leftCols<kOfCalibration>() = landmark.B();
  const auto put = [&](int place, const auto& B) {
    B_.middleCols<kBlock>(offset(static_cast<int>(places_of_B_.size()))) = B;
    places_of_B_.push_back(place);
  };
  for (const Landmark::NodeTerms& terms : landmark) put(place_of(nodes_, terms.number), terms.B);
  for (const Landmark::SpellTerms& terms : landmark.spells()) put(place_of(spells_, terms.number), terms.B);

  const PointMatrix A_inverse = sign * landmark.A().inverse();
  const Point mean = A_inverse * landmark.b();
  const auto calibration = B_.leftCols<kOfCalibration>();
  const Eigen::Matrix<double, kPointSize, kOfCalibration> gain = A_inverse * calibration;
  matrix_.topLeftCorner<kOfCalibration, kOfCalibration>() -= gain.transpose() * calibration;
  vector_.head<kOfCalibration>() += calibration.transpose() * mean;
  const int count = static_cast<int>(places_of_B_.size());
  for (int i = 0; i < count; ++i) {
    const auto B = B_.middleCols<kBlock>(offset(i));
    const Eigen::Index row = offset(places_of_B_[i]);
    const Eigen::Matrix<double, kOfCalibration, kBlock> with_calibration = gain.transpose() * B;
    matrix_.block<kOfCalibration, kBlock>(0, row) -= with_calibration;
    matrix_.block<kBlock, kOfCalibration>(row, 0) -= with_calibration.transpose();
    vector_.segment<kBlock>(row) += B.transpose() * mean;
    const Eigen::Matrix<double, kPointSize, kBlock> gain_of_block = A_inverse * B;
    for (int k = 0; k < count; ++k) {
      matrix_.block<kBlock, kBlock>(row, offset(places_of_B_[k])) -=
          gain_of_block.transpose() * B_.middleCols<kBlock>(offset(k));
      couple(places_of_B_[i], places_of_B_[k]);
    }
  }
}

/// C and g.
void SettledSums::add_own(const Landmark& landmark) {
  const auto add_between = [&](int a, int b, const auto& block) {
    matrix_.block<kBlock, kBlock>(offset(a), offset(b)) += block;
    matrix_.block<kBlock, kBlock>(offset(b), offset(a)) += block.transpose();
    couple(a, b);
  };
  const auto add_block = [&](int place, const auto& terms) {
    const Eigen::Index at = offset(place);
    matrix_.block<kOfCalibration, kBlock>(0, at) += terms.C_calibration;
    matrix_.block<kBlock, kOfCalibration>(at, 0) += terms.C_calibration.transpose();
    matrix_.block<kBlock, kBlock>(at, at) += terms.C_own;
    vector_.segment<kBlock>(at) += terms.g;
    couple(place, place);
  };
  matrix_.topLeftCorner<kOfCalibration, kOfCalibration>() += landmark.C();
  vector_.head<kOfCalibration>() += landmark.g();
  for (const Landmark::NodeTerms& own : landmark) {
    const int place = place_of(nodes_, own.number);
    add_block(place, own);
    const Landmark::NodeTerms* const next = &own + 1;
    if (next != landmark.end() && next->number == own.number + 1)
      add_between(place, place_of(nodes_, next->number), own.C_next);
  }
  for (const Landmark::SpellTerms& own : landmark.spells()) {
    const int place = place_of(spells_, own.number);
    add_block(place, own);
    for (std::uint32_t side = 0; side < 2; ++side) {
      if (own.C_node[side].isZero(0.0)) continue;
      add_between(place_of(nodes_, own.node + side), place, own.C_node[side]);
    }
  }
}

/// h(gone) = sum of weights * h(by) + deviation, put into 1/2 h' M h - v' h. Those of `by` below 0 have
/// weight 0.
void SettledSums::substitute(int gone, const std::array<int, 2>& by, const std::array<double, 2>& weights,
                             const Eigen::Matrix<double, kBlock, 1>& deviation) {
  const Eigen::Index from = offset(gone);
  vector_ -= matrix_.middleCols<kBlock>(from) * deviation;
  for (std::size_t i = 0; i < by.size(); ++i) {
    if (by[i] < 0) continue;
    const Eigen::Index to = offset(by[i]);
    matrix_.middleRows<kBlock>(to) += weights[i] * matrix_.middleRows<kBlock>(from);
    vector_.segment<kBlock>(to) += weights[i] * vector_.segment<kBlock>(from);
  }
  for (std::size_t i = 0; i < by.size(); ++i) {
    if (by[i] < 0) continue;
    matrix_.middleCols<kBlock>(offset(by[i])) += weights[i] * matrix_.middleCols<kBlock>(from);
    for (int other = 0; other < are_coupled_.rows(); ++other) {
      if (are_coupled_(gone, other)) couple(by[i], other);
    }
  }
  if (by[0] >= 0 && by[1] >= 0 && are_coupled_(gone, gone)) {
    couple(by[0], by[0]);
    couple(by[0], by[1]);
    couple(by[1], by[1]);
  }
  release(gone);
}

void SettledSums::release(int place) {
  matrix_.middleRows<kBlock>(offset(place)).setZero();
  matrix_.middleCols<kBlock>(offset(place)).setZero();
  vector_.segment<kBlock>(offset(place)).setZero();
  are_coupled_.row(place).setConstant(false);
  are_coupled_.col(place).setConstant(false);
  free_.push_back(place);
}

/// Nodes before it are called by a number higher by one from now on, so that those after it come one place
/// forward.
void SettledSums::thin(const ThinnedNode& node) {
  if (nodes_.places.empty()) return;
  if (nodes_.has(node.number)) {
    const int gone = nodes_.of(node.number);
    const int before = place_of(nodes_, node.number - 1), after = place_of(nodes_, node.number + 1);
    substitute(gone, {before, after}, {1.0 - node.weight_of_next, node.weight_of_next}, node.deviation);
    nodes_.places.erase(nodes_.places.begin() + (node.number - nodes_.begin));
    ++nodes_.begin;
  } else if (nodes_.end() <= node.number) {
    ++nodes_.begin;
  }
}

/// h(gone) = constant + per_focal e.
void SettledSums::substitute_by_focal(int gone, const Spell& spell) {
  constexpr int kFocal = CalibrationIndex::kFocal;
  const Eigen::Index from = offset(gone);
  vector_ -= matrix_.middleCols<kBlock>(from) * spell.constant();
  vector_[kFocal] += spell.per_focal.dot(vector_.segment<kBlock>(from));
  matrix_.row(kFocal) += spell.per_focal.transpose() * matrix_.middleRows<kBlock>(from);
  matrix_.col(kFocal) += matrix_.middleCols<kBlock>(from) * spell.per_focal;
  release(gone);
}

/// Nothing is there to do where the oldest is not settled.
void SettledSums::freeze_oldest_node(const DriftTimeline& drift) {
  if (!nodes_.has(drift.begin())) return;
  substitute(nodes_.of(drift.begin()), {-1, -1}, {0.0, 0.0}, drift.node(drift.begin()).mean);
  nodes_.drop_oldest();
}

void SettledSums::freeze_oldest_spell(const DriftTimeline& drift) {
  const SwayTimeline& sway = drift.sway();
  if (!spells_.has(sway.begin())) return;
  substitute_by_focal(spells_.of(sway.begin()), sway.spell(sway.begin()));
  spells_.drop_oldest();
}

void SettledSums::freeze_latency(double latency_s) {
  constexpr int kLatency = CalibrationIndex::kLatency;
  vector_ -= matrix_.col(kLatency) * latency_s;
  matrix_.col(kLatency).setZero();
  matrix_.row(kLatency).setZero();
  vector_[kLatency] = 0.0;
}

void SettledSums::list_columns(const HeadLayout& layout) const {
  columns_.clear();
  for (std::uint32_t number = spells_.begin; number != spells_.end(); ++number)
    columns_.push_back({layout.column_of_spell(number), spells_.of(number)});
  for (std::uint32_t number = nodes_.begin; number != nodes_.end(); ++number)
    columns_.push_back({layout.column_of(number), nodes_.of(number)});
}

void SettledSums::add_to(EnvelopeCholesky& information, Eigen::Ref<Eigen::VectorXd> right_hand_side,
                         const HeadLayout& layout) const {
  if (is_empty_) return;
  list_columns(layout);
  const Eigen::Index last = layout.column_of_calibration();
  information.block<kOfCalibration, kOfCalibration>(last, last) +=
      matrix_.topLeftCorner<kOfCalibration, kOfCalibration>();
  right_hand_side.segment<kOfCalibration>(last) += vector_.head<kOfCalibration>();
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const Column& row = columns_[i];
    const Eigen::Index at = offset(row.place);
    if (!are_coupled_(row.place, row.place)) continue;
    right_hand_side.segment<kBlock>(row.in_head) += vector_.segment<kBlock>(at);
    information.block<kOfCalibration, kBlock>(last, row.in_head) +=
        matrix_.block<kOfCalibration, kBlock>(0, at);
    for (std::size_t k = 0; k <= i; ++k) {
      if (!are_coupled_(row.place, columns_[k].place)) continue;
      information.block<kBlock, kBlock>(row.in_head, columns_[k].in_head) +=
          matrix_.block<kBlock, kBlock>(at, offset(columns_[k].place));
    }
  }
}

}  // namespace geoloc
