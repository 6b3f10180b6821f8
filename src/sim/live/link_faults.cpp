// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/live/link_faults.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geoloc/geometry/problems.hpp"
#include "geoloc/geometry/refuse.hpp"

namespace geoloc::sim {

std::vector<std::string> LinkFaults::problems() const {
  Problems found;
  found.require(loss >= 0.0 && loss <= 1.0, "loss must lie in [0, 1]");
  found.require(delay_s >= 0.0 && delay_s <= 60.0, "link_delay must lie in [0, 60] s");
  found.require(jitter_s >= 0.0 && jitter_s <= 60.0, "link_jitter must lie in [0, 60] s");
  return found.take();
}

FaultyLink::FaultyLink(const LinkFaults& faults, std::uint64_t seed) : faults_(faults), random_(seed) {
  refuse_if_any(faults.problems());
}

void FaultyLink::send(Datagram datagram, HostTime now) {
  const bool lost = random_.chance(faults_.loss);
  const double extra_s = -faults_.jitter_s * std::log(1.0 - random_.uniform(0.0, 1.0));
  if (lost) return;
  HostTime arrives_at = now + from_seconds(faults_.delay_s + extra_s);
  if (!under_way_.empty()) arrives_at = std::max(arrives_at, under_way_.back().arrives_at);
  under_way_.push_back({arrives_at, std::move(datagram)});
}

std::optional<FaultyLink::Datagram> FaultyLink::receive(HostTime now) {
  if (under_way_.empty() || under_way_.front().arrives_at > now) return std::nullopt;
  Datagram datagram = std::move(under_way_.front().datagram);
  under_way_.pop_front();
  return datagram;
}

}  // namespace geoloc::sim
