// SPDX-License-Identifier: Apache-2.0
#include "tracking/latency_change.hpp"

#include <algorithm>
#include <array>

#include "tracking/frame_boxes.hpp"
#include "tracking/latency_scores.hpp"

namespace geoloc {
namespace {

/// A step that is less likely than the likeliest one by so much in log likelihood is not considered.
constexpr double kMostBehind = 6.0;
/// By what a step ahead is likelier where the stamps leave a gap for it: twice what is considered. The gap
/// may be shorter than the step by what is not known of either.
constexpr double kNoGap = 2.0 * kMostBehind, kGapMargin_s = 0.1;
/// Frames see the same objects in the same places for so long: they count as one.
constexpr double kCountsAsOne_s = 0.5;

/// What a frame tells, in log likelihood, where it and the earlier one that it is compared with lie before
/// the step, on either side of it, and after it.
struct Evidence {
  double before = 0.0;
  double across = 0.0;
  double after = 0.0;
  std::size_t compared_with = 0;  // the frame itself: with none
};

class ChangeSearch {
 public:
  ChangeSearch(const WaitingFrames& frames, const LatencyChange& change, const PlaceFit& fit,
               const std::vector<WatchedPlace>& places)
      : frames_(frames), change_(change), fit_(fit), places_(places), usual_gap_s_(usual_gap_s()) {
    for (std::size_t i = 0; i < frames_.size(); ++i) evidence_[i] = evidence_of(i);
  }

  ChangeOfLatency likely_range() {
    double sum = 0.0;
    for (std::size_t i = 0; i < frames_.size(); ++i) sum += evidence_[i].after;
    const double all = likelihood_[0] = sum + prior(0);
    double best = all;
    for (std::size_t first = 1; first <= frames_.size(); ++first) {
      sum += evidence_[first - 1].before - evidence_[first - 1].after;
      likelihood_[first] = sum + across(first) + prior(first);
      best = std::max(best, likelihood_[first]);
    }
    ChangeOfLatency change{0, frames_.size(), best - all};
    while (likelihood_[change.first_possible] < best - kMostBehind) ++change.first_possible;
    while (likelihood_[change.first_certain] < best - kMostBehind) --change.first_certain;
    return change;
  }

 private:
  static constexpr double kStep_s = LatencyScores::kStep_s;

  double seconds_between(std::size_t a, std::size_t b) const {
    return seconds(frames_.stamp(b).captured_at_host - frames_.stamp(a).captured_at_host);
  }

  double weight(std::size_t i) const {
    return i == 0 ? 1.0 : std::min(1.0, seconds_between(i - 1, i) / kCountsAsOne_s);
  }

  Evidence evidence_of(std::size_t i) const {
    const FrameBoxes now = frames_.boxes(i);
    const auto before = fit_.tally(now, change_.before_s, kStep_s, places_);
    const auto after = fit_.tally(now, change_.after_s, kStep_s, places_);
    if (!before || !after) return {0.0, 0.0, 0.0, i};
    Evidence evidence{before->likelihood, after->likelihood, after->likelihood, i};
    const auto time_of = [&](std::size_t n) { return frames_.stamp(n).captured_at_host; };
    const auto earlier = frames_to_compare(time_of(i), i, [&](std::size_t n) { return time_of(i - n); });
    if (earlier) add_pair(i - *earlier, now, evidence);
    const double weighs = weight(i);
    return {weighs * evidence.before, weighs * evidence.across, weighs * evidence.after,
            evidence.compared_with};
  }

  void add_pair(std::size_t earlier, const FrameBoxes& now, Evidence& evidence) const {
    const FrameBoxes then = frames_.boxes(earlier);
    const auto likelihood = [&](double then_s, double now_s) {
      const auto tally = fit_.tally_of_pair(then, now, {then_s, now_s}, kStep_s);
      return tally ? tally->likelihood : 0.0;
    };
    evidence.compared_with = earlier;
    evidence.before += likelihood(change_.before_s, change_.before_s);
    evidence.across += likelihood(change_.before_s, change_.after_s);
    evidence.after += likelihood(change_.after_s, change_.after_s);
  }

  /// What the frames compared with one before the step tell otherwise than by the later latency of both.
  double across(std::size_t first) const {
    double sum = 0.0;
    for (std::size_t i = first; i < frames_.size() && evidence_[i].compared_with < first; ++i)
      sum += evidence_[i].across - evidence_[i].after;
    return sum;
  }

  /// Of a clock that is set ahead: the stamps must leave room for it.
  double prior(std::size_t first) const {
    const double step_s = change_.after_s - change_.before_s;
    const auto before = first == 0 ? frames_.left_at() : frames_.stamp(first - 1).captured_at_host;
    if (!before || first == frames_.size() || step_s < kGapMargin_s) return 0.0;
    const double gap_s = seconds(frames_.stamp(first).captured_at_host - *before) - usual_gap_s_;
    return gap_s > step_s - kGapMargin_s ? 0.0 : -kNoGap;
  }

  double usual_gap_s() {
    const auto gaps = static_cast<std::ptrdiff_t>(frames_.size()) - 1;
    if (gaps < 1) return 0.0;
    for (std::ptrdiff_t i = 0; i < gaps; ++i)
      gaps_s_[static_cast<std::size_t>(i)] =
          seconds_between(static_cast<std::size_t>(i), static_cast<std::size_t>(i) + 1);
    const auto middle = gaps_s_.begin() + gaps / 2;
    std::nth_element(gaps_s_.begin(), middle, gaps_s_.begin() + gaps);
    return *middle;
  }

  const WaitingFrames& frames_;
  const LatencyChange& change_;
  const PlaceFit& fit_;
  const std::vector<WatchedPlace>& places_;
  std::array<Evidence, WaitingFrames::kMost> evidence_;
  std::array<double, WaitingFrames::kMost + 1> likelihood_;
  std::array<double, WaitingFrames::kMost> gaps_s_;
  double usual_gap_s_;
};

}  // namespace

ChangeOfLatency find_change(const WaitingFrames& frames, const LatencyChange& change, const PlaceFit& fit,
                            const std::vector<WatchedPlace>& places) {
  return ChangeSearch(frames, change, fit, places).likely_range();
}

}  // namespace geoloc
