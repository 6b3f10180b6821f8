// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "geoloc/geometry/time.hpp"

namespace geoloc {

/// Tells a reboot of the vehicle (its boot clock goes back) from packets that come late or with a damaged
/// stamp. One stray stamp proves nothing: a reboot is believed when several consecutive stamps agree on the
/// new time.
class BootClockMonitor {
 public:
  enum class Verdict {
    kAdvanced,  ///< the newest stamp so far, or late by less than max_lateness: use the sample
    kSuspect,   ///< far from the others and not confirmed: drop the sample
    kRebooted   ///< confirmed: forget what was known of the old clock, then use the sample
  };

  Verdict observe(VehicleTime stamp) {
    if (!newest_ || is_plausible(stamp, *newest_)) {
      if (!newest_ || stamp > *newest_) newest_ = stamp;
      suspects_ = 0;
      return Verdict::kAdvanced;
    }
    suspects_ = suspects_ > 0 && is_plausible(stamp, suspect_) ? suspects_ + 1 : 1;
    suspect_ = stamp;
    if (suspects_ < kConfirmations) return Verdict::kSuspect;
    newest_ = stamp;
    suspects_ = 0;
    return Verdict::kRebooted;
  }

 private:
  /// Longer than any link holds a packet back, shorter than an autopilot takes to boot and fly.
  static constexpr Duration kMaxLateness = std::chrono::seconds{5};
  /// A link may be silent for long, but a stamp a day ahead is damage.
  static constexpr Duration kMaxSilence = std::chrono::hours{24};
  static constexpr int kConfirmations = 3;

  static bool is_plausible(VehicleTime stamp, VehicleTime reference) {
    return stamp - reference > -kMaxLateness && stamp - reference < kMaxSilence;
  }

  std::optional<VehicleTime> newest_;
  VehicleTime suspect_{};
  int suspects_ = 0;
};

}  // namespace geoloc
