// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>

namespace geoloc {

/// How well each of many latencies explains a run of frames. The vehicle's states of some come later than
/// those of others, so that each has its own count of frames.
class LatencyScores {
 public:
  static constexpr double kStep_s = 0.05;
  static constexpr int kReach = 70;
  static constexpr int kSize = 2 * kReach + 1;
  static constexpr int kEdge = 3;

  /// Whether the best latency may lie beyond those that are tried.
  static constexpr bool is_at_edge(int n) { return n < kEdge || n >= kSize - kEdge; }

  static double latency_s(int number) { return (number - kReach) * kStep_s; }

  struct Score {
    std::size_t frames = 0;
    double by_places = 0.0;  ///< sum over the frames,
    double by_pairs = 0.0;   ///< in logarithms

    double sum() const { return by_places + by_pairs; }
    double mean() const { return frames > 0 ? sum() / static_cast<double>(frames) : 0.0; }
  };

  /// Latencies in a row that explain the frames about as well as the best one.
  struct Peak {
    int best;
    int first;
    int last;

    double half_width_s() const { return 0.5 * (last - first + 1) * kStep_s; }
  };

  Score& operator[](int number) { return scores_[static_cast<std::size_t>(number)]; }
  const Score& operator[](int number) const { return scores_[static_cast<std::size_t>(number)]; }

  void clear() { scores_.fill({}); }

  /// Whether even the one whose states come last has so many frames.
  bool are_complete(std::size_t least_frames) const { return scores_.front().frames >= least_frames; }

  /// The one of the highest mean among those that have so many frames.
  std::optional<int> best(std::size_t least_frames) const {
    std::optional<int> best;
    for (int n = 0; n < kSize; ++n) {
      if ((*this)[n].frames < least_frames) continue;
      if (!best || (*this)[n].mean() > (*this)[*best].mean()) best = n;
    }
    return best;
  }

  /// The peak around `best`, of those within `lead` of its mean; nullopt where there is another one.
  std::optional<Peak> only_peak(int best, double lead) const {
    const auto is_near = [&](int n) { return (*this)[best].mean() - (*this)[n].mean() < lead; };
    Peak peak{best, best, best};
    while (peak.first > 0 && is_near(peak.first - 1)) --peak.first;
    while (peak.last + 1 < kSize && is_near(peak.last + 1)) ++peak.last;
    for (int n = 0; n < kSize; ++n) {
      if ((n < peak.first || n > peak.last) && is_near(n)) return std::nullopt;
    }
    return peak;
  }

 private:
  std::array<Score, static_cast<std::size_t>(kSize)> scores_{};
};

}  // namespace geoloc
