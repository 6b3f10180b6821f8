// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "geoloc/geometry/time.hpp"
#include "geoloc/io/mavlink/frame.hpp"
#include "geoloc/io/mavlink/link_source.hpp"

namespace geoloc::io {

/// Which source speaks for an autopilot: the one that sends its state. Others under the same system are
/// refused as long as it goes on; where nobody sends state, sources have their turns, so that each can be
/// asked.
class VehicleSources {
 public:
  /// `silence`: a source that sends no state for so long may be replaced.
  explicit VehicleSources(Duration silence) : silence_(silence) {}

  /// A frame of `sender` came from there. False where it is refused. Other components than autopilots have no
  /// rule.
  bool admits(MavAddress sender, bool is_state, const LinkSource& source, HostTime now);

  struct Refusal {
    std::uint8_t system = 0;
    LinkSource refused;
    LinkSource speaks;
    HostTime at;
  };
  /// The last one.
  const std::optional<Refusal>& last_refusal() const { return last_refusal_; }

 private:
  struct Speaker {
    LinkSource source;
    HostTime since;
    std::optional<HostTime> last_state;
  };

  bool may_replace(const Speaker& speaker, bool is_state, HostTime now) const;

  Duration silence_;
  std::array<std::optional<Speaker>, 256> speakers_;  // by system
  std::optional<Refusal> last_refusal_;
};

}  // namespace geoloc::io
