// SPDX-License-Identifier: Apache-2.0
#include "tracking/clock_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/room.hpp"
#include "tracking/frame_boxes.hpp"

namespace geoloc {
namespace {

/// From what doubt on frames are held back, and how much of it is kept: so that a few good frames end it.
constexpr double kDoubtToHold = 3.0, kMostDoubt = 12.0;
/// New objects that come into view, per frame.
constexpr double kNewPerFrame = 0.2;
/// Frames see the same objects in the same places for so long: they count as one.
constexpr double kIndependent_s = 0.5;
/// What another latency must be better by to be believed, than the present one and than chance: it is one of
/// 141 (ln 141 = 5), with as much to spare; by what it must lead the others, and what is not worth holding
/// frames for.
constexpr double kLeastGain = 10.0, kLeastLead = 6.0, kNoGain = 5.0;
/// Attitudes that are off by a degree for seconds look like another latency to pairs of frames: where known
/// places do not agree (kLeastAgreement), pairs must tell twice as much; where places tell it, pairs may
/// speak against it by kMostAgainst.
constexpr double kLeastAgreement = 1.0, kLeastGainByPairsAlone = 20.0, kMostAgainst = 2.0;
/// Frames, and their span, before any is judged.
constexpr std::size_t kLeastFrames = 10;
constexpr double kLeastSpan_s = 1.0;
/// One object alone may have been mistaken for another.
constexpr std::size_t kLeastPlaces = 2;
/// Frames are held for no longer; where nothing was found, none are for a while, longer each time.
constexpr double kLongestHold_s = 12.0, kBackOff_s = 20.0;
/// 1-sigma of a latency that was found.
constexpr double kLeastSigma_s = 0.05;
/// Between two frames that prove the latency together.
constexpr double kLongestBetween_s = 2.0;
/// What a frame is worth whose state is not known at a latency.
constexpr double kUnknown = -10.0;
/// So many of the held frames tell of a shift.
constexpr std::size_t kFramesForShift = 32;

bool is_another(int number, double believed_s) {
  return std::abs(LatencyScores::latency_s(number) - believed_s) >= kLeastLatencyChange_s;
}

}  // namespace

ClockWatch::ClockWatch(int most_places) : back_off_s_(kBackOff_s) {
  take_room(this, most_places);
}

std::size_t ClockWatch::take_room(ClockWatch* self, int most_places) {
  return room::reserve(self, &ClockWatch::places_, most_places) +
         room::reserve(self, &ClockWatch::held_, kMostFrames);
}

void ClockWatch::begin_anew() {
  doubt_ = 0.0;
  is_holding_ = false;
  is_proven_ = false;
  held_.clear();
  quiet_until_.reset();
  told_at_.reset();
  shown_.reset();
  back_off_s_ = kBackOff_s;
}

std::optional<LatencyPrior> ClockWatch::observe(FrameStamp stamp,
                                                const std::vector<LocatedDetection>& detections,
                                                const PlaceFit& fit) {
  const double believed_s = fit.believed_latency_s();
  const HostTime now = stamp.captured_at_host;
  const FrameBoxes frame(stamp, detections);
  weigh(frame, fit, believed_s);
  if (is_backing_off(now) || (!is_holding_ && doubt_ < kDoubtToHold)) return std::nullopt;
  hold(frame);
  score_held(fit);
  const auto found = decide(fit, believed_s);
  if (found) {
    begin_anew();
  } else if (has_wandered_) {
    give_up(now, kBackOff_s);
  } else if (held_.size() == kMostFrames || span_s(held_.size()) > kLongestHold_s) {
    give_up(now, back_off_s_ *= 2.0);
  } else if (doubt_ < kDoubtToHold && gain(fit, believed_s) < kNoGain) {
    is_holding_ = false;
  }
  return found;
}

/// Evidence that the latency is another one: objects that should be in view are missed, while boxes show
/// nothing known, as they would with all of them displaced. A frame without boxes is none: the detector may
/// see nothing. Neither is a frame of a vehicle that hovers, which shows the same at any latency.
void ClockWatch::weigh(const FrameBoxes& frame, const PlaceFit& fit, double believed_s) {
  is_proven_ = false;
  const auto tally = fit.tally(frame, believed_s, 0.0, places_);
  if (!tally) return;
  if (tally->seen + tally->missed > 0) told_at_ = frame.stamp.captured_at_host;
  if (is_forgotten(frame.stamp.captured_at_host)) doubt_ = 0.0;
  const WatchExpectation& expected = fit.expected();
  const int strange = tally->unexplained == 0 ? 0 : fit.strange_boxes(frame, believed_s, places_);
  const double displaced = fit.found_in(frame) * (tally->seen + tally->missed);
  const double usually_strange = kNewPerFrame + expected.strange_per_frame;
  double evidence = strange * std::log1p(displaced / usually_strange) - displaced - tally->likelihood;
  if (strange == 0 || !fit.could_tell_latency(frame, believed_s, places_)) evidence = std::min(evidence, 0.0);
  doubt_ = std::clamp(doubt_ + evidence, 0.0, kMostDoubt);
  const bool shows = !is_holding_ && !is_in_doubt() && tally->seen > 0 && tally->seen >= tally->missed &&
                     fit.tells_latency(frame, believed_s, places_);
  is_proven_ = shows && is_shown_again(frame.stamp.captured_at_host);
  if (is_in_doubt()) shown_.reset();
}

/// One frame may show other objects in the known places by chance: a clock that stepped shows neighbours
/// there.
bool ClockWatch::is_shown_again(HostTime now) {
  if (!shown_ || seconds(now - shown_->last) > kLongestBetween_s) shown_ = Shown{now, now};
  shown_->last = now;
  return seconds(now - shown_->first) >= kIndependent_s;
}

/// None of the places that were known when the doubt began is to be seen any more: it would last for ever.
bool ClockWatch::is_forgotten(HostTime now) const {
  return !is_holding_ && told_at_ && seconds(now - *told_at_) > kLongestHold_s;
}

bool ClockWatch::is_backing_off(HostTime now) {
  if (quiet_until_ && (now > *quiet_until_ || !is_in_doubt())) quiet_until_.reset();
  return quiet_until_.has_value();
}

void ClockWatch::hold(const FrameBoxes& frame) {
  if (!is_holding_) {
    held_.clear();
    scores_.clear();
  }
  is_holding_ = true;
  held_.push_back(frame);
}

void ClockWatch::score_held(const PlaceFit& fit) {
  for (int n = 0; n < LatencyScores::kSize; ++n) {
    const double latency_s = LatencyScores::latency_s(n);
    Score& score = scores_[n];
    while (score.frames < held_.size() &&
           add_score(score.frames, latency_s, LatencyScores::kStep_s, fit, score)) {
    }
  }
}

/// False where the vehicle's state is not known.
bool ClockWatch::add_score(std::size_t frame, double latency_s, double step_s, const PlaceFit& fit,
                           Score& score) const {
  const auto tally = fit.tally(held_[frame], latency_s, step_s, places_);
  if (!tally) return false;
  score.by_places += tally->likelihood;
  ++score.frames;
  const auto time_of = [this](std::size_t n) { return held_[n].stamp.captured_at_host; };
  const auto earlier =
      frames_to_compare(time_of(frame), frame, [&](std::size_t n) { return time_of(frame - n); });
  if (!earlier) return true;
  const auto pair = fit.tally_of_pair(held_[frame - *earlier], held_[frame], {latency_s, latency_s}, step_s);
  if (pair) score.by_pairs += pair->likelihood;
  return true;
}

ClockWatch::Score ClockWatch::score_of(double latency_s, double step_s, std::size_t frames,
                                       const PlaceFit& fit) const {
  Score score;
  for (std::size_t i = 0; i < frames; ++i) {
    if (!add_score(i, latency_s, step_s, fit, score)) score.by_places += kUnknown;
  }
  score.frames = frames;
  return score;
}

double ClockWatch::span_s(std::size_t frames) const {
  return seconds(held_[frames - 1].stamp.captured_at_host - held_.front().stamp.captured_at_host);
}

/// As how many independent ones so many frames count.
double ClockWatch::weight(std::size_t frames) const {
  return std::min(static_cast<double>(frames), 1.0 + span_s(frames) / kIndependent_s);
}

/// By how much another latency explains the held frames better than the one believed.
double ClockWatch::gain(const PlaceFit& fit, double believed_s) const {
  const auto best = scores_.best(std::min(kLeastFrames, held_.size()));
  if (!best || !is_another(*best, believed_s)) return 0.0;
  const Score& found = scores_[*best];
  return gain(found, score_of(believed_s, LatencyScores::kStep_s, found.frames, fit));
}

double ClockWatch::gain(const Score& found, const Score& believed) const {
  return weight(found.frames) * (found.mean() - believed.mean());
}

std::optional<LatencyPrior> ClockWatch::decide(const PlaceFit& fit, double believed_s) {
  has_wandered_ = false;
  if (!scores_.are_complete(kLeastFrames)) return std::nullopt;
  const auto best = scores_.best(kLeastFrames);
  if (!best || LatencyScores::is_at_edge(*best) || !is_another(*best, believed_s)) return std::nullopt;
  const Score& found = scores_[*best];
  const Score believed = score_of(believed_s, LatencyScores::kStep_s, found.frames, fit);
  if (gain(found, believed) < kLeastGain) return std::nullopt;
  if (weight(found.frames) * found.mean() < kLeastGain) return std::nullopt;
  const auto peak = scores_.only_peak(*best, kLeastLead / weight(found.frames));
  if (!peak || span_s(found.frames) < kLeastSpan_s) return std::nullopt;
  const double latency_s = LatencyScores::latency_s(*best);
  if (!is_told(found, believed, latency_s, fit)) return std::nullopt;
  has_wandered_ = has_wandered(found, believed, fit, believed_s);
  if (has_wandered_) return std::nullopt;
  return LatencyPrior{refined_s(latency_s, found.frames, fit),
                      std::max(kLeastSigma_s, 0.5 * peak->half_width_s())};
}

/// By how the vehicle turned between frames, or by several known objects, that the turning does not gainsay.
bool ClockWatch::is_told(const Score& found, const Score& believed, double latency_s,
                         const PlaceFit& fit) const {
  const double per_frame = weight(found.frames) / static_cast<double>(found.frames);
  const double gain_by_pairs = per_frame * (found.by_pairs - believed.by_pairs);
  const double by_places = per_frame * found.by_places;
  if (gain_by_pairs >= (by_places >= kLeastAgreement ? kLeastGain : kLeastGainByPairsAlone)) return true;
  if (gain_by_pairs <= -kMostAgainst || by_places < kLeastGain) return false;
  PlaceFit::SeenPlaces seen;
  for (std::size_t i = 0; i < found.frames; ++i)
    fit.tally(held_[i], latency_s, LatencyScores::kStep_s, places_, nullptr, &seen);
  return seen.count() >= kLeastPlaces;
}

/// The shift of the vehicle's position that would bring boxes to the known places near them: the median.
std::optional<Eigen::Vector2d> ClockWatch::likely_shift(std::size_t frames, const PlaceFit& fit,
                                                        double believed_s) {
  std::size_t count = 0;
  const std::size_t stride = 1 + frames / kFramesForShift;
  for (std::size_t i = 0; i < frames; i += stride) {
    fit.for_each_shift(held_[i], believed_s, places_, [&](const Eigen::Vector2d& shift_m) {
      if (count == kMostShifts) return;
      east_m_[count] = shift_m.x();
      north_m_[count++] = shift_m.y();
    });
  }
  if (count == 0) return std::nullopt;
  const auto median = [count](std::array<double, kMostShifts>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(count));
    return *middle;
  };
  return Eigen::Vector2d(median(east_m_), median(north_m_));
}

/// Whether a vehicle's position that has wandered would explain as well what another latency does.
bool ClockWatch::has_wandered(const Score& found, const Score& believed, const PlaceFit& fit,
                              double believed_s) {
  const auto shift_m = likely_shift(found.frames, fit, believed_s);
  if (!shift_m) return false;
  const double cost = 0.5 * shift_m->squaredNorm() / std::pow(fit.expected().wandering_m, 2);
  double likelihood = 0.0;
  for (std::size_t i = 0; i < found.frames; ++i) {
    const auto tally = fit.tally(held_[i], believed_s, LatencyScores::kStep_s, places_, &*shift_m);
    likelihood += tally ? tally->likelihood : kUnknown;
  }
  const double per_frame = weight(found.frames) / static_cast<double>(found.frames);
  return per_frame * (found.sum() - likelihood - believed.by_pairs) + cost < kLeastGain;
}

double ClockWatch::refined_s(double coarse_s, std::size_t frames, const PlaceFit& fit) const {
  constexpr int kFineSteps = 10;
  const double fine_s = 2.0 * LatencyScores::kStep_s / kFineSteps;
  double best_s = coarse_s, best = -std::numeric_limits<double>::infinity();
  for (int fine = -kFineSteps; fine <= kFineSteps; ++fine) {
    const double latency_s = coarse_s + fine * fine_s;
    const double sum = score_of(latency_s, fine_s, frames, fit).sum();
    if (sum <= best) continue;
    best = sum;
    best_s = latency_s;
  }
  return best_s;
}

void ClockWatch::give_up(HostTime now, double back_off_s) {
  quiet_until_ = now + from_seconds(back_off_s);
  is_holding_ = false;
  held_.clear();
}

}  // namespace geoloc
