// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "geoloc/geometry/time.hpp"

namespace geoloc {

/// Tells a reboot of the vehicle (its boot clock goes back) from packets that come late or with a damaged
/// stamp. One stray stamp proves nothing, neither back nor ahead: a jump either way is believed when several
/// consecutive stamps agree on the new time. After a pause of the link that costs the first two samples.
class BootClockMonitor {
 public:
  enum class Verdict {
    kAdvanced,  ///< near the newest stamp so far, or a confirmed jump ahead of it: use the sample
    kSuspect,   ///< far from the others and not confirmed: drop the sample
    kRebooted   ///< a confirmed jump back: forget what was known of the old clock, then use the sample
  };

  Verdict observe(VehicleTime stamp) {
    if (!newest_ || is_near(stamp, *newest_)) {
      if (!newest_ || stamp > *newest_) newest_ = stamp;
      suspects_ = 0;
      return Verdict::kAdvanced;
    }
    suspects_ = suspects_ > 0 && is_near(stamp, suspect_) ? suspects_ + 1 : 1;
    suspect_ = stamp;
    if (suspects_ < kConfirmations) return Verdict::kSuspect;
    const Verdict verdict = stamp < *newest_ ? Verdict::kRebooted : Verdict::kAdvanced;
    newest_ = stamp;
    suspects_ = 0;
    return verdict;
  }

  /// Whether observe() would take it without further ones.
  bool is_near_newest(VehicleTime stamp) const { return newest_ && is_near(stamp, *newest_); }

 private:
  /// Longer than any link holds a packet back, shorter than an autopilot takes to boot and fly. The same both
  /// ways: a smaller stray step ahead must leave the stamps that follow it near.
  static constexpr Duration kMaxStep = std::chrono::seconds{5};
  static constexpr int kConfirmations = 3;

  static bool is_near(VehicleTime stamp, VehicleTime reference) {
    return stamp - reference > -kMaxStep && stamp - reference < kMaxStep;
  }

  std::optional<VehicleTime> newest_;
  VehicleTime suspect_{};
  int suspects_ = 0;
};

}  // namespace geoloc
