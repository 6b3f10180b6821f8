// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/geometry/time.hpp"
#include "geoloc/sim/random.hpp"

namespace geoloc::sim {

struct LinkFaults {
  double loss = 0.0;      ///< share of the datagrams that get lost
  double delay_s = 0.0;   ///< [s] the least time a datagram is under way
  double jitter_s = 0.0;  ///< [s] mean of what comes on top, exponentially distributed

  /// Every fault, named by its JSON path.
  std::vector<std::string> problems() const;
};

/// One direction of a bad link. Datagrams do not overtake each other.
class FaultyLink {
 public:
  using Datagram = std::vector<std::uint8_t>;

  /// Throws std::invalid_argument naming every problem.
  FaultyLink(const LinkFaults& faults, std::uint64_t seed);

  void send(Datagram datagram, HostTime now);

  /// The next datagram that has arrived by now.
  std::optional<Datagram> receive(HostTime now);

 private:
  struct UnderWay {
    HostTime arrives_at;
    Datagram datagram;
  };

  LinkFaults faults_;
  Random random_;
  std::deque<UnderWay> under_way_;
};

}  // namespace geoloc::sim
