// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "geoloc/projection/ground_fix.hpp"
#include "tracking/calibrated_viewer.hpp"
#include "tracking/frame_boxes.hpp"

namespace geoloc {

/// Finds out whether frames are stamped with another latency than they are taken to be.
/// Nothing need be known of the ground for it: what one frame shows, the next one shows too, moved by how the
/// vehicle turned in between; and a vehicle in wind turns differently a third of a second later. (The same is
/// done to align a camera's clock with a gyroscope's.) Does not allocate after construction.
class LatencyWatch {
 public:
  LatencyWatch();
  /// geometry/room.hpp
  static std::size_t take_room(LatencyWatch* self);

  /// A frame, and what is believed of the latency. The latency that explains the last frames far better,
  /// where there is one. At the start that is mostly the latency of the whole flight.
  std::optional<double> observe(FrameStamp stamp, const std::vector<LocatedDetection>& detections,
                                const CalibratedViewer& viewer);

  /// Whether so little has been seen yet that a latency found is that of the flight from its beginning on.
  bool is_at_start() const;

  /// What has been seen tells the latency: another one that is found from now on is that of a clock that has
  /// stepped. Without effect while there were too few pairs of frames to look for one, as in stills that lie
  /// seconds apart.
  void end_start();

  /// The flight begins anew.
  void begin_anew();

 private:
  static constexpr std::size_t kFrames = 128;

  /// Mean square of how far boxes lie from where an earlier frame tells them to be, none farther than some
  /// pixels.
  struct Distance {
    double sum_px2 = 0.0;
    int looks = 0;

    double mean_px2() const { return looks > 0 ? sum_px2 / looks : 0.0; }
    void add(double px2) {
      sum_px2 += px2;
      ++looks;
    }
    void add(const Distance& other) {
      sum_px2 += other.sum_px2;
      looks += other.looks;
    }
    /// By how much boxes lie better, in all.
    double gain_px2(const Distance& worse) const {
      return (worse.mean_px2() - mean_px2()) * (looks < worse.looks ? looks : worse.looks);
    }
  };

  class Grid;

  const FrameBoxes& frame(std::size_t age) const { return frames_[(next_ + kFrames - 1 - age) % kFrames]; }
  bool is_due() const;
  template <typename Visit>
  void visit_pair(std::size_t age, double latency_s, const CalibratedViewer& viewer,
                  const Visit& visit) const;
  bool makes_a_pair(double latency_s, const CalibratedViewer& viewer) const;
  Distance distance_of_pair(std::size_t age, double latency_s, const CalibratedViewer& viewer) const;
  std::size_t newest_known(double latency_s, const CalibratedViewer& viewer) const;
  Distance distance(double latency_s, const CalibratedViewer& viewer, std::size_t least_age = 0) const;
  static bool is_hopeless(const Distance& distance);
  bool is_far_better(double latency_s, double present_s, const CalibratedViewer& viewer) const;
  std::optional<double> search(const CalibratedViewer& viewer) const;
  double refined_s(double coarse_s, const CalibratedViewer& viewer) const;

  std::vector<FrameBoxes> frames_;  // a ring
  std::size_t next_ = 0;
  std::size_t size_ = 0;
  int pairs_ = 0;  // since the start
  bool is_over_ = false;
};

}  // namespace geoloc
