// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "calibration/arrowhead.hpp"

namespace geoloc {

/// What the objects that are out of view tell of the head, as one total: sum (C - B' A^-1 B) and sum (g + B'
/// A^-1 b) over all of them (docs/method.md). A solution costs as much whether they are few or many. The
/// total follows the head as each object's own sums do, and exactly: nodes that are thinned out, nodes,
/// spells and latencies that are frozen. Never allocates after construction.
class SettledSums {
 public:
  /// Room for as many nodes and spells as `drift` allows.
  explicit SettledSums(const DriftConfig& drift);
  /// geometry/room.hpp
  static std::size_t take_room(SettledSums* self, const DriftConfig& drift);

  /// The object is eliminated: it tells no more of the head until it is restored.
  void settle(const Landmark& landmark);

  /// Undoes the elimination of an object whose A, b and B these are, so that it can be estimated again. Its C
  /// and g stay here: the landmark has none of them.
  void restore(const Landmark& landmark);

  /// Each is about to be done to `drift` (as in Landmark).
  void thin(const ThinnedNode& node);
  void freeze_oldest_node(const DriftTimeline& drift);
  void freeze_oldest_spell(const DriftTimeline& drift);

  /// The latency of all looks so far is known from now on.
  void freeze_latency(double latency_s);

  /// Nothing is settled.
  void clear();

  /// Adds the total to the lower triangle of the head's information and to its right-hand side.
  void add_to(EnvelopeCholesky& information, Eigen::Ref<Eigen::VectorXd> right_hand_side,
              const HeadLayout& layout) const;

 private:
  static constexpr int kBlock = kNodeSize;
  static_assert(kSwaySize == kBlock, "nodes and spells share their places");
  using PointColumns = Eigen::Matrix<double, kPointSize, Eigen::Dynamic>;

  /// Numbers that follow each other, each with a place in the matrix.
  struct Places {
    std::uint32_t begin = 0;
    std::vector<int> places;

    std::uint32_t end() const { return begin + static_cast<std::uint32_t>(places.size()); }
    bool has(std::uint32_t number) const { return number >= begin && number < end(); }
    int of(std::uint32_t number) const { return places[number - begin]; }
    void drop_oldest() {
      places.erase(places.begin());
      ++begin;
    }
  };

  /// Where a node or a spell stands in the head and in the total.
  struct Column {
    Eigen::Index in_head;
    int place;
  };

  static Eigen::Index offset(int place) { return CalibrationIndex::kSize + Eigen::Index{kBlock} * place; }
  int place_of(Places& of, std::uint32_t number);
  void substitute(int gone, const std::array<int, 2>& by, const std::array<double, 2>& weights,
                  const Eigen::Matrix<double, kBlock, 1>& deviation);
  void substitute_by_focal(int gone, const Spell& spell);
  void release(int place);
  void couple(int a, int b);
  void add_eliminated(const Landmark& landmark, double sign);
  void add_own(const Landmark& landmark);
  void list_columns(const HeadLayout& layout) const;

  Eigen::MatrixXd matrix_;  // symmetric: the calibration, then the places
  Eigen::VectorXd vector_;
  Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic> are_coupled_;  // places
  Places nodes_;
  Places spells_;
  std::vector<int> free_;
  bool is_empty_ = true;
  // Scratch: an object's B, block by block.
  PointColumns B_;
  std::vector<int> places_of_B_;
  mutable std::vector<Column> columns_;
};

}  // namespace geoloc
