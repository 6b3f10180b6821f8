// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "calibration/settled_sums.hpp"
#include "tracking/block_pool.hpp"
#include "tracking/place_index.hpp"
#include "tracking/resting_object.hpp"

namespace geoloc {

/// Objects that no frame shows for a while, without their tracks. They cost no time until they are near a
/// frame's view again: what they tell of the head is in the settled sums, and A, b and B, which tell where
/// they are, follow the head's nodes when they are asked for. Allocates as they become more.
class SleepingObjects {
 public:
  using Key = std::uint32_t;

  /// Room for as many nodes as `drift` allows, and for so many objects.
  explicit SleepingObjects(const DriftConfig& drift, std::size_t at_first = 0);
  /// geometry/room.hpp
  static std::size_t take_room(SleepingObjects* self, const DriftConfig& drift, std::size_t at_first);

  std::size_t size() const { return index_.size(); }

  /// Room for so many, where they were seen in passing.
  void reserve(std::size_t count);

  /// What they tell of the head.
  const SettledSums& settled() const { return settled_; }
  SettledSums& settled() { return settled_; }

  /// The object is its caller's to forget, but for its track.
  void put(const RestingObject& object, const DriftTimeline& drift);

  /// The keys of those that may be in the area. The reference holds until the next call.
  const std::vector<Key>& near(const Eigen::AlignedBox2d& area);

  std::uint64_t id_of(Key key) const { return sleepers_[key].id; }
  /// As of when it was last brought up to date.
  const Eigen::Vector2d& position_of(Key key) const { return sleepers_[key].position_in_enu; }

  /// Puts all but the track into `object`; refresh() is the caller's.
  void wake(Key key, DriftTimeline& drift, RestingObject& object);

  /// Calls visit(id, landmark, neighbours) for each, as it would wake: its sums by the nodes of `drift`,
  /// which is the one that it was put with.
  template <typename Visit>
  void for_each(DriftTimeline& drift, const Visit& visit) const {
    Landmark landmark;
    for (Key key = 0; key < sleepers_.end(); ++key) {
      const Sleeper& sleeper = sleepers_[key];
      if (sleeper.id == 0) continue;
      restore(sleeper, drift, landmark);
      visit(sleeper.id, landmark, sleeper.neighbours);
    }
  }

  /// Brings some of them up to date, in turn: so many, and as many more as all of them need to be visited
  /// before the drift forgets its nodes. Calls visit(id, published_at, position, landmark) for each, whose
  /// landmark has no C and no g.
  template <typename Visit>
  void visit_some(std::size_t least, SharedErrorEstimate& errors, const Visit& visit) {
    for (std::size_t left = due(least, errors.drift.nodes_made()); left > 0; --left) {
      const Key key = next_in_turn();
      const Point position = bring_up_to_date(key, errors);
      visit(sleepers_[key].id, sleepers_[key].published_at, position, scratch_);
    }
  }

  /// Forgets those without looks until then. What they tell of the head stays. Calls visit(id) for each.
  template <typename Visit>
  void forget_since(VehicleTime then, const Visit& visit) {
    for (Key key = 0; key < sleepers_.end(); ++key) {
      if (sleepers_[key].id == 0 || sleepers_[key].sums_since <= then) continue;
      visit(sleepers_[key].id);
      forget(key);
    }
  }

  /// The latency of all looks so far is known from now on.
  void freeze_latency(double latency_s);

  void clear();

 private:
  static constexpr Key kNone = std::numeric_limits<Key>::max();

  /// B of a node, by its serial number, or of a spell.
  struct Term {
    std::uint32_t number = 0;
    bool is_spell = false;
    Landmark::NodeRows B;
  };

  /// Some of an object's terms. They lie together, since what is slow is to fetch them from memory.
  struct Terms {
    static constexpr std::size_t kMost = 3;
    std::array<Term, kMost> terms;
    std::size_t count = 0;
    Key next = kNone;
  };

  struct Sleeper {
    std::uint64_t id = 0;  // 0: the place is free
    std::size_t published_at = 0;
    Existence existence{0.5};
    Neighbours neighbours;
    VehicleTime last_look{};
    VehicleTime sums_since{};
    double size_m = 0.0;
    bool was_confirmed = false;
    Mixture mixture;
    PointInformation ground;
    PointMatrix pixel_information;
    PointMatrix A;
    Point b;
    Landmark::CalibrationRows B;
    Eigen::Vector2d position_in_enu;
    Key first_terms = kNone;
  };

  void drop_terms(Sleeper& sleeper);
  void forget(Key key);
  void restore(const Sleeper& sleeper, DriftTimeline& drift, Landmark& landmark) const;
  void keep_terms(Sleeper& sleeper, const Landmark& landmark, const DriftTimeline& drift);
  Point bring_up_to_date(Key key, SharedErrorEstimate& errors);
  Key next_in_turn();
  std::size_t due(std::size_t least, std::uint32_t nodes_made);

  SettledSums settled_;
  BlockPool<Sleeper> sleepers_;
  BlockPool<Terms> terms_;
  PlaceIndex index_;
  Key turn_ = 0;       // was visited last
  double owed_ = 0.0;  // visits; below 0: some were made ahead
  std::uint32_t nodes_made_ = 0;
  std::vector<Key> near_;
  Landmark scratch_;
};

}  // namespace geoloc
