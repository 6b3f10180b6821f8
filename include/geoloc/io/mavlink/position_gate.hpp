// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "geoloc/io/mavlink/messages.hpp"

namespace geoloc::io {

/// Whether the vehicle knows where it is. Before that its messages carry latitude and longitude 0, or a
/// position that may be tens of kilometres off. The receiver and the estimator each have a veto once they
/// have been heard. On a link that carries neither, every position except 0, 0 passes.
class PositionGate {
 public:
  void observe(const GnssStatus& status) { gnss_ = status; }
  void observe(const EstimatorStatus& status) { estimator_ = status; }

  bool admits(const Geodetic& position) const {
    constexpr std::uint8_t kFix3d = 3;
    if (position.latitude_deg == 0.0 && position.longitude_deg == 0.0) return false;
    if (gnss_ && gnss_->fix_type < kFix3d) return false;
    return !estimator_ || estimator_->has_absolute_position();
  }

  const std::optional<GnssStatus>& gnss() const { return gnss_; }

 private:
  std::optional<GnssStatus> gnss_;
  std::optional<EstimatorStatus> estimator_;
};

}  // namespace geoloc::io
