// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "calibration/arrowhead.hpp"
#include "tracking/latency_scores.hpp"
#include "tracking/place_fit.hpp"

namespace geoloc {

/// Finds out in mid-flight that a clock has stepped: frames are stamped with another latency than before.
/// Known objects tell it with the first frame in which none of them is where it should be; which latency it
/// is, the next seconds tell. Until then frames are best not used: they can be, later, from where they were
/// seen. Does not allocate after construction.
class ClockWatch {
 public:
  explicit ClockWatch(int most_places);
  /// geometry/room.hpp
  static std::size_t take_room(ClockWatch* self, int most_places);

  /// Where objects should be. To be listed anew before each frame while there is no doubt; in doubt, what was
  /// known before is what tells.
  std::vector<WatchedPlace>& places() { return places_; }
  bool is_in_doubt() const { return doubt_ > 0.0; }

  /// A new frame. The latency since it, or since an earlier frame that is held, where that is found to be
  /// another one.
  std::optional<LatencyPrior> observe(FrameStamp stamp, const std::vector<LocatedDetection>& detections,
                                      const PlaceFit& fit);

  /// Whether the frame is to be held back, with all since the first one that was.
  bool holds() const { return is_holding_; }

  /// Whether the frame shows that the latency is as believed.
  bool proves() const { return is_proven_; }

  /// A new flight.
  void begin_anew();

 private:
  static constexpr std::size_t kMostFrames = 256;
  static constexpr std::size_t kMostShifts = 256;
  using Score = LatencyScores::Score;

  void weigh(const FrameBoxes& frame, const PlaceFit& fit, double believed_s);
  bool is_shown_again(HostTime now);
  bool is_forgotten(HostTime now) const;
  bool is_backing_off(HostTime now);
  void hold(const FrameBoxes& frame);
  void score_held(const PlaceFit& fit);
  bool add_score(std::size_t frame, double latency_s, double step_s, const PlaceFit& fit, Score& score) const;
  Score score_of(double latency_s, double step_s, std::size_t frames, const PlaceFit& fit) const;
  double span_s(std::size_t frames) const;
  double weight(std::size_t frames) const;
  double gain(const PlaceFit& fit, double believed_s) const;
  double gain(const Score& found, const Score& believed) const;
  std::optional<LatencyPrior> decide(const PlaceFit& fit, double believed_s);
  bool is_told(const Score& found, const Score& believed, double latency_s, const PlaceFit& fit) const;
  std::optional<Eigen::Vector2d> likely_shift(std::size_t frames, const PlaceFit& fit, double believed_s);
  bool has_wandered(const Score& found, const Score& believed, const PlaceFit& fit, double believed_s);
  double refined_s(double coarse_s, std::size_t frames, const PlaceFit& fit) const;
  void give_up(HostTime now, double back_off_s);

  std::vector<WatchedPlace> places_;
  double doubt_ = 0.0;  // log likelihood ratio of "another latency" against "chance", within bounds
  bool is_holding_ = false;
  bool is_proven_ = false;
  bool has_wandered_ = false;
  std::vector<FrameBoxes> held_;
  LatencyScores scores_;
  std::optional<HostTime> quiet_until_;
  std::optional<HostTime> told_at_;  // the last frame that should show one of the places
  struct Shown {
    HostTime first, last;
  };
  std::optional<Shown> shown_;  // the frames in a row that show known objects in place
  double back_off_s_;
  std::array<double, kMostShifts> east_m_{}, north_m_{};  // scratch of likely_shift
};

}  // namespace geoloc
