// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "geoloc/geometry/time.hpp"
#include "geoloc/io/mavlink/claimed_sigma.hpp"
#include "geoloc/io/mavlink/messages.hpp"

namespace geoloc::io {

/// Why a position of the vehicle is not used.
enum class PositionRefusal {
  kNoPlace,            ///< latitude and longitude are 0
  kNoFix,              ///< as the receiver says
  kNoAbsolutePosition  ///< as the estimator says
};

/// Whether the vehicle knows where it is. Before that its messages carry latitude and longitude 0, or a
/// position that may be tens of kilometres off. The receiver and the estimator each have a veto for some
/// seconds after they said so: both repeat it while it holds, and one false message does not end a flight. On
/// a link that carries neither, every position except 0, 0 passes.
class PositionGate {
 public:
  void observe(const GnssStatus& status, HostTime at) { note(status, at, gnss_, gnss_claims_); }
  void observe(const EstimatorStatus& status, HostTime at) {
    note(status, at, estimator_, estimator_claims_);
  }

  /// nullopt where the position may be used.
  std::optional<PositionRefusal> refusal(const Geodetic& position, HostTime now) const {
    if (position.latitude_deg == 0.0 && position.longitude_deg == 0.0) return PositionRefusal::kNoPlace;
    return veto(now);
  }

  /// Why no position would be used now.
  std::optional<PositionRefusal> veto(HostTime now) const {
    constexpr std::uint8_t kFix3d = 3;
    if (is_fresh(gnss_, now) && gnss_->status.fix_type < kFix3d) return PositionRefusal::kNoFix;
    if (is_fresh(estimator_, now) && !estimator_->status.has_absolute_position())
      return PositionRefusal::kNoAbsolutePosition;
    return std::nullopt;
  }

  /// The estimator takes what the receiver tells for false.
  bool has_gnss_glitch(HostTime now) const {
    return is_fresh(estimator_, now) && estimator_->status.has_gnss_glitch;
  }

  std::optional<std::uint8_t> fix_type() const {
    if (!gnss_) return std::nullopt;
    return gnss_->status.fix_type;
  }

  /// What the receiver claims or, where it claims nothing, the estimator. While the estimator takes the
  /// receiver's positions for false it goes on without them: then the larger claim counts.
  std::optional<double> sigma_horizontal_m(HostTime now) const {
    const auto receivers = is_fresh(gnss_, now) ? gnss_claims_.value_m() : std::nullopt;
    const auto estimators = is_fresh(estimator_, now) ? estimator_claims_.value_m() : std::nullopt;
    if (!receivers || !estimators) return receivers ? receivers : estimators;
    return has_gnss_glitch(now) ? std::max(*receivers, *estimators) : *receivers;
  }

 private:
  template <typename Status>
  struct Heard {
    Status status;
    HostTime at;
  };

  static constexpr Duration kLasts = std::chrono::seconds{5};  // both come every two seconds at least

  template <typename Status>
  static bool is_fresh(const std::optional<Heard<Status>>& heard, HostTime now) {
    return heard && now - heard->at <= kLasts;
  }

  template <typename Status>
  static void note(const Status& status, HostTime at, std::optional<Heard<Status>>& last,
                   ClaimedSigma& claims) {
    if (!status.sigma_horizontal_m || !is_fresh(last, at)) claims.clear();
    if (status.sigma_horizontal_m) claims.add(*status.sigma_horizontal_m);
    last = {status, at};
  }

  std::optional<Heard<GnssStatus>> gnss_;
  std::optional<Heard<EstimatorStatus>> estimator_;
  ClaimedSigma gnss_claims_;
  ClaimedSigma estimator_claims_;
};

}  // namespace geoloc::io
