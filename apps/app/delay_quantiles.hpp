// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "geoloc/geometry/time.hpp"

namespace geoloc::apps {

/// Quantiles of delays between 0.1 ms and 100 s, to 1 %: a histogram of constant size.
class DelayQuantiles {
 public:
  void add(Duration delay) {
    ++counts_[bin_of(1e3 * seconds(delay))];
    ++count_;
  }

  std::uint64_t count() const { return count_; }

  /// The delay that so large a share of all does not exceed; 0 before the first. share: (0, 1]
  double ms(double share) const {
    const auto wanted = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count_)));
    std::uint64_t below = 0;
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      below += counts_[bin];
      if (below >= std::max<std::uint64_t>(wanted, 1))
        return kLeast_ms * std::exp(kStep * (static_cast<double>(bin) + 0.5));
    }
    return 0.0;
  }

 private:
  static constexpr double kLeast_ms = 0.1, kStep = 0.02;
  static constexpr std::size_t kBins = 691;  // ln(1e6) / kStep

  static std::size_t bin_of(double ms) {
    const double bin = std::log(std::max(ms, kLeast_ms) / kLeast_ms) / kStep;
    return std::min(static_cast<std::size_t>(bin), kBins - 1);
  }

  std::array<std::uint64_t, kBins> counts_{};
  std::uint64_t count_ = 0;
};

/// Where the time between a frame's capture and its objects goes.
struct FrameDelays {
  DelayQuantiles to_arrival;  ///< capture, encoding, network and decoding
  DelayQuantiles in_search;   ///< the wait for the detector and its work
  DelayQuantiles in_wait;     ///< for the telemetry after the frame, and the estimation
  DelayQuantiles total;
};

}  // namespace geoloc::apps
