// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "geoloc/geometry/time.hpp"

namespace geoloc::io {

/// Whether the vehicle's state is asked for at the fast rate. A frame waits for the telemetry after it, 50 ms
/// in the mean at 10 Hz, so that a fast link brings objects sooner. The fast rate is tried where round trips
/// are short, and given up where it fills the link: round trips become long, more messages are lost than
/// before, or the rate does not come. Each trial that fails doubles the pause until the next one.
class LinkPace {
 public:
  /// What the link has brought.
  struct Heard {
    std::uint64_t frames = 0;  ///< of the vehicle, since the link began
    std::uint64_t lost = 0;    ///< of those, by their sequence numbers
    bool is_fast = false;      ///< attitude and position come at the fast rate, or nearly
  };

  /// The vehicle is another one, rebooted or was out of reach.
  void restart();

  void on_round_trip(Duration trip);

  /// To be called often. True where is_fast() has changed.
  bool update(HostTime now, const Heard& heard);

  bool is_fast() const { return is_fast_; }

 private:
  static constexpr std::size_t kTrips = 9;  // kept per window, the newest

  bool bears_it(const Heard& heard, double lost_share) const;
  void try_fast(double lost_share);
  void give_up(HostTime now);
  bool is_quick() const;
  std::optional<Duration> usual_trip() const;

  bool is_fast_ = false;
  std::optional<HostTime> window_end_;
  Heard at_begin_;
  int windows_ = 0;            ///< of the trial
  double usually_lost_ = 0.0;  ///< share of the frames, before the trial
  std::optional<HostTime> pause_until_;
  Duration pause_ = kFirstPause;
  std::array<Duration, kTrips> trips_{};
  std::size_t trip_count_ = 0;  ///< in the window

  static constexpr Duration kFirstPause = std::chrono::minutes{1};
};

}  // namespace geoloc::io
