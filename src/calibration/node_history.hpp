// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace geoloc {

/// What has become of the drift's nodes since they were made. Nodes are called by their serial numbers here,
/// which stay. A node that was thinned out is a mean of its neighbours and a constant, and these may have
/// gone the same way since: whatever was thinned, it is a mean of at most two nodes that are left, which are
/// neighbours. Never allocates after construction.
class NodeHistory {
 public:
  /// So many nodes are remembered: whoever calls one by its serial number asks for it before as many more
  /// were made.
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

  NodeHistory() : fates_(kRemembered) {}

  /// How many nodes were made.
  std::uint32_t size() const { return size_; }

  /// A node is made. Returns its serial number.
  std::uint32_t append();

  /// It is left out.
  void replace(std::uint32_t serial, const Blend& by);

  /// By nodes that are left. Remembers what it found.
  Blend resolve(std::uint32_t serial);

 private:
  struct Fate {
    bool is_gone = false;
    Blend blend;
  };

  Fate& fate_of(std::uint32_t serial) { return fates_[serial % kRemembered]; }

  std::vector<Fate> fates_;  // a ring
  std::uint32_t size_ = 0;
};

}  // namespace geoloc
