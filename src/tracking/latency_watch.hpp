// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "geoloc/projection/ground_fix.hpp"
#include "tracking/calibrated_viewer.hpp"

namespace geoloc {

/// Objects known for a while, where frames of the present show them: offset and drift of the vehicle undone.
struct KnownPlaces {
  static constexpr std::size_t kMost = 16;

  std::array<Eigen::Vector3d, kMost> shown_in_enu;
  std::size_t count = 0;
};

/// Finds out whether frames are stamped with another latency than they are taken to be. Nothing need be known
/// of the ground for it: what one frame shows, the next one shows too, moved by how the vehicle turned in
/// between; and a vehicle in wind turns differently a third of a second later. (The same is done to align a
/// camera's clock with a gyroscope's.) Where it flies straight, objects that are known already tell. Does not
/// allocate after construction.
class LatencyWatch {
 public:
  struct Change {
    double latency_s;
    HostTime since;  ///< the first frame that it explains better
  };

  LatencyWatch();

  /// A frame, and what is believed of the latency. The latency that explains the last frames far better,
  /// where there is one: the flight began with another than expected, or a clock has stepped.
  std::optional<Change> observe(FrameStamp stamp, const std::vector<LocatedDetection>& detections,
                                const CalibratedViewer& viewer, const KnownPlaces& known);

  /// Since when frames have not fitted, and no other latency has been found that explains them. Objects begun
  /// since then tell nothing of it.
  const std::optional<HostTime>& doubtful_since() const { return doubtful_since_; }

  /// Whether the latency found is that of the flight from its beginning on.
  bool is_at_start() const;

  /// The flight begins anew.
  void begin_anew();

  /// Frames so far were of another latency.
  void forget();

 private:
  static constexpr std::size_t kMostPixels = 8;
  static constexpr std::size_t kFrames = 128;

  struct Frame {
    FrameStamp stamp;
    std::array<Eigen::Vector2d, kMostPixels> pixels;
    std::size_t count = 0;
  };

  /// Mean square of how far boxes lie from where they should be, none farther than some pixels.
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
  };

  /// How well a latency explains frames.
  struct Fit {
    Distance from_before;  ///< from where an earlier frame tells boxes to be
    Distance from_known;   ///< from where known objects are
  };

  struct Scene {
    const CalibratedViewer& viewer;
    const KnownPlaces& known;
  };

  class Grid;

  const Frame& frame(std::size_t age) const { return frames_[(next_ + kFrames - 1 - age) % kFrames]; }
  std::optional<std::size_t> partner(std::size_t age) const;
  Fit fit_of_pair(std::size_t age, double latency_s, const Scene& scene) const;
  Fit fit(double latency_s, const Scene& scene) const;
  bool is_due(const Fit& newest);
  void weigh_doubt(const Fit& newest);
  std::optional<double> search(const Scene& scene) const;
  static double gain_px2(const Distance& other, const Distance& present);
  static bool is_certain(const Distance& other, const Distance& present);
  double least_change_by_known(const Scene& scene) const;
  HostTime time_of_change(double latency_before_s, double latency_s, const Scene& scene) const;

  std::vector<Frame> frames_;  // a ring
  std::size_t next_ = 0;
  std::size_t size_ = 0;
  int pairs_ = 0;           // since the start
  double usual_px2_ = 0.0;  // of pairs that fit
  int misfits_ = 0;         // pairs that do not fit, in a row but for one
  int pairs_since_misfit_ = 0;
  bool had_fit_between_ = false;
  std::optional<HostTime> doubtful_since_;
  int looks_in_place_ = 0;
  HostTime misfit_since_{};
};

}  // namespace geoloc
