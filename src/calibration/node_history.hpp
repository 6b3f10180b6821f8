// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace geoloc {

/// What has become of the drift's nodes that are gone. Nodes are called by their serial numbers here, which
/// stay. A node that was thinned out is a mean of its neighbours and a constant, and these may go the same
/// way: whatever was thinned, it is a mean of at most two nodes that are left, which are neighbours. Never
/// allocates after construction.
class NodeHistory {
 public:
  /// So many of those that are gone are remembered. Nodes stay for as long as they are of use, some for
  /// hours: it counts when they went, and not when they were made.
  static constexpr std::uint32_t kRemembered = 1024;

  using Vector = Eigen::Matrix<double, 4, 1>;
  struct Share {
    std::uint32_t serial = 0;
    double weight = 0.0;  ///< 0: none
  };
  /// d = sum of weights * d(of those nodes) + constant.
  struct Blend {
    std::array<Share, 2> shares;
    Vector constant = Vector::Zero();
  };

  NodeHistory();
  /// geometry/room.hpp
  static std::size_t take_room(NodeHistory* self);

  /// How many nodes were made.
  std::uint32_t size() const { return size_; }

  /// A node is made. Returns its serial number.
  std::uint32_t append() { return size_++; }

  /// It is left out. `by`: nodes that are left.
  void replace(std::uint32_t serial, const Blend& by);

  /// By nodes that are left: itself, or those that took its place.
  Blend resolve(std::uint32_t serial) const;

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  /// Of a node that is gone.
  struct Fate {
    std::uint32_t serial = kNone;
    std::uint32_t next = kNone;  // in the chain of its serial number
    Blend blend;                 // of nodes that are left
  };

  std::uint32_t& chain_of(std::uint32_t serial) { return chains_[serial % kRemembered]; }
  void forget(std::uint32_t place);

  std::vector<Fate> fates_;            // a ring, in the order in which they went
  std::vector<std::uint32_t> chains_;  // by serial number: the first of those that share a remainder
  std::uint32_t oldest_ = 0;           // the place that is taken next
  std::uint32_t size_ = 0;
};

}  // namespace geoloc
