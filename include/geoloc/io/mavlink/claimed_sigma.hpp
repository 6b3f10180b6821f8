// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

namespace geoloc::io {

/// A sigma that is claimed again and again. One false claim among others has no effect.
class ClaimedSigma {
 public:
  void add(double sigma_m) {
    if (count_ == claims_m_.size()) {
      std::move(claims_m_.begin() + 1, claims_m_.end(), claims_m_.begin());
      --count_;
    }
    claims_m_[count_++] = sigma_m;
  }

  void clear() { count_ = 0; }

  /// The median of the last three claims, or the first of fewer; nullopt before that.
  std::optional<double> value_m() const {
    if (count_ == 0) return std::nullopt;
    const auto& [a, b, c] = claims_m_;
    if (count_ < claims_m_.size()) return a;
    return std::max(std::min(a, b), std::min(std::max(a, b), c));
  }

 private:
  std::array<double, 3> claims_m_{};  // oldest first
  std::size_t count_ = 0;
};

}  // namespace geoloc::io
