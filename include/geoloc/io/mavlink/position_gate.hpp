// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "geoloc/geometry/time.hpp"
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
  void observe(const GnssStatus& status, HostTime at) {
    if (!status.sigma_horizontal_m || !is_fresh(gnss_, at)) claims_count_ = 0;
    if (status.sigma_horizontal_m) note_claim(*status.sigma_horizontal_m);
    gnss_ = {status, at};
  }
  void observe(const EstimatorStatus& status, HostTime at) { estimator_ = {status, at}; }

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

  /// What the receiver claims: the median of its last three claims, or its first, so that one false claim
  /// among others has no effect.
  std::optional<double> sigma_horizontal_m(HostTime now) const {
    if (claims_count_ == 0 || !is_fresh(gnss_, now)) return std::nullopt;
    const auto& [a, b, c] = claims_m_;
    if (claims_count_ < claims_m_.size()) return a;
    return std::max(std::min(a, b), std::min(std::max(a, b), c));
  }

 private:
  template <typename Status>
  struct Heard {
    Status status;
    HostTime at;
  };

  static constexpr Duration kLasts = std::chrono::seconds{5};  // both come once a second at least

  template <typename Status>
  static bool is_fresh(const std::optional<Heard<Status>>& heard, HostTime now) {
    return heard && now - heard->at <= kLasts;
  }

  void note_claim(double sigma_m) {
    if (claims_count_ == claims_m_.size()) {
      std::move(claims_m_.begin() + 1, claims_m_.end(), claims_m_.begin());
      --claims_count_;
    }
    claims_m_[claims_count_++] = sigma_m;
  }

  std::optional<Heard<GnssStatus>> gnss_;
  std::optional<Heard<EstimatorStatus>> estimator_;
  std::array<double, 3> claims_m_{};  // oldest first
  std::size_t claims_count_ = 0;
};

}  // namespace geoloc::io
