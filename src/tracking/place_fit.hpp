// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <bitset>
#include <cstddef>
#include <optional>
#include <vector>

#include "tracking/calibrated_viewer.hpp"
#include "tracking/frame_boxes.hpp"

namespace geoloc {

/// Where frames of the present show an object: offset and drift of the vehicle undone.
struct WatchedPlace {
  Eigen::Vector3d shown_in_enu;
  double sigma_m;     ///< of the object by itself: horizontal, per axis,
  double sigma_up_m;  ///< and of its height above the camera's
  double wandering;   ///< share of the vehicle's wandering that has come since it was seen
  bool is_known;      ///< for long enough to tell of the latency; else it only explains boxes
};

/// What is known of detector and vehicle.
struct WatchExpectation {
  double found;              ///< probability that an object in view is found
  double strange_per_frame;  ///< boxes that show nothing known
  double sigma_px;
  double sigma_attitude_rad;
  double wandering_m;  ///< 1-sigma per axis of the position, and of what the attitude makes of it
};

/// How well the boxes of frames fit places, at any latency: log likelihood ratios of "this box shows that
/// object" against "it lies there by chance", the density of chance being that of the boxes around.
class PlaceFit {
 public:
  struct Tally {
    int seen = 0;
    int missed = 0;
    std::size_t unexplained = 0;  ///< boxes that show none of the places
    double likelihood = 0.0;
  };
  using SeenPlaces = std::bitset<64>;
  struct LatencyOfPair {
    double before_s;
    double now_s;
  };

  PlaceFit(const CalibratedViewer& viewer, const WatchExpectation& expected)
      : viewer_(viewer), expected_(expected) {}

  /// What known places say of a frame; nullopt where the vehicle's state is not known. step_s: by which the
  /// latency may be off. shift_m: the vehicle's wandering, as far as it is not in the places. seen: receives
  /// the places that are in view and found.
  std::optional<Tally> tally(const FrameBoxes& frame, double latency_s, double step_s,
                             const std::vector<WatchedPlace>& places,
                             const Eigen::Vector2d* shift_m = nullptr, SeenPlaces* seen = nullptr) const;

  /// What an earlier frame's boxes say: what it shows of the ground, the later one should show as well.
  /// Nothing need be known of the ground for that, but the vehicle must turn or tilt in between.
  std::optional<Tally> tally_of_pair(const FrameBoxes& before, const FrameBoxes& now,
                                     const LatencyOfPair& latency, double step_s) const;

  /// Boxes that no place explains, known or not.
  int strange_boxes(const FrameBoxes& frame, double latency_s, const std::vector<WatchedPlace>& places) const;

  /// Whether a known place is seen that would not be if the latency was another.
  bool tells_latency(const FrameBoxes& frame, double latency_s,
                     const std::vector<WatchedPlace>& places) const;

  /// Whether a known place should be seen that would not be if the latency was quite another: not where the
  /// vehicle hovers.
  bool could_tell_latency(const FrameBoxes& frame, double latency_s,
                          const std::vector<WatchedPlace>& places) const;

  /// By how much the vehicle's position would have had to wander for the frame's boxes nearest to known
  /// places to show them.
  template <typename Use>
  void for_each_shift(const FrameBoxes& frame, double latency_s, const std::vector<WatchedPlace>& places,
                      const Use& use) const;

  const WatchExpectation& expected() const { return expected_; }
  double believed_latency_s() const { return viewer_.errors.calibration.latency_s(); }

  /// Probability that an object in view has one of these boxes.
  double found_in(const FrameBoxes& frame) const { return expected_.found * frame.share; }

 private:
  template <typename Counts>
  bool any_that_moves(const FrameBoxes& frame, double latency_s, double other_by_s,
                      const std::vector<WatchedPlace>& places, const Counts& counts) const;
  struct Range {
    const WatchedPlace* begin;
    std::size_t count;
  };

  Tally tally(const FrameBoxes& frame, const FrameView& view, double step_s, Range places,
              const Eigen::Vector2d* shift_m, SeenPlaces* seen) const;
  double likelihood_of(const Eigen::Vector2d& shown, double variance_px2, const FrameBoxes& frame,
                       std::bitset<FrameBoxes::kMost>& taken) const;
  std::optional<Eigen::Vector2d> shown(const Eigen::Vector3d& place, const FrameView& view) const;
  double radius_px(const WatchedPlace& place, const FrameView& view, double wandering_m) const;
  bool is_inside(const Eigen::Vector2d& pixel, double radius_px) const;
  double size() const;

  const CalibratedViewer& viewer_;
  const WatchExpectation& expected_;
};

template <typename Use>
void PlaceFit::for_each_shift(const FrameBoxes& frame, double latency_s,
                              const std::vector<WatchedPlace>& places, const Use& use) const {
  constexpr double kLeastWandering = 0.1, kSigmas = 4.0, kReach_m = 0.3;
  const auto view = viewer_.at(frame.stamp, latency_s);
  if (!view) return;
  for (const WatchedPlace& place : places) {
    if (!place.is_known || place.wandering < kLeastWandering) continue;
    const auto pixel = shown(place.shown_in_enu, *view);
    if (!pixel) continue;
    const auto here = viewer_.projector.project(*pixel, *view);
    if (!here) continue;
    double nearest_m = kSigmas * place.wandering * expected_.wandering_m + kReach_m;
    std::optional<Eigen::Vector2d> nearest;
    for (std::size_t k = 0; k < frame.count; ++k) {
      const auto there = viewer_.projector.project(frame.pixels[k], *view);
      if (!there) continue;
      const Eigen::Vector2d by = there->position_in_enu - here->position_in_enu;
      if (by.norm() >= nearest_m) continue;
      nearest_m = by.norm();
      nearest = by;
    }
    if (nearest) use(Eigen::Vector2d(*nearest / place.wandering));
  }
}

}  // namespace geoloc
