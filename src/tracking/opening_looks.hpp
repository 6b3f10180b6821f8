// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "calibration/drift.hpp"
#include "geoloc/camera/detection.hpp"
#include "geoloc/projection/ground_fix.hpp"
#include "tracking/joint_frame.hpp"
#include "tracking/look_maker.hpp"
#include "tracking/recent_looks.hpp"
#include "tracking/track_table.hpp"

namespace geoloc {

/// The looks of a flight's first frames, as they were before they were linearised. Little is known of
/// boresight and height then, and what looks tell depends on both; so they are linearised anew with each
/// solution until enough is known (Gauss-Newton). Bounded; later looks are linearised once.
class OpeningLooks {
 public:
  OpeningLooks();
  /// geometry/room.hpp
  static std::size_t take_room(OpeningLooks* self);

  /// Whether the looks of all frames so far are here.
  bool is_open() const { return is_open_; }

  /// All looks so far are forgotten: the flight begins anew.
  void restart();

  /// A drift node is frozen: what looks say of it is not to be solved for any more.
  void close() { is_open_ = false; }

  /// A frame to whose looks add() adds. Closes where there is no more room.
  void begin_frame(FrameStamp stamp, const JointFrame& frame, double looks_that_share);
  void add(std::uint64_t track_id, const Detection& detection);

  /// Track `gone` is now called `kept`.
  void rename(std::uint64_t gone, std::uint64_t kept);

  /// All sums of the objects at rest, from these looks and what is known from elsewhere. A frame from when
  /// the vehicle's state is known no more is seen from where it was last time; one that never was is left
  /// out. They are then all that `recent` holds, as they were added.
  void linearise_anew(const FrameViewer& viewer, const Projector& projector, const LookMaker& maker,
                      const SharedErrorEstimate& errors, TrackTable& tracks, RecentLooks& recent);

 private:
  struct Frame {
    FrameStamp stamp;
    std::optional<FrameView> nominal_view;  // as last looked up
    double terrain_m;                       // of the frame's view
    VehicleTime time;                       // as it was taken to be
    NodeSpan span;
    NoiseRepetition repetition;
    double looks_that_share;
    RunTimeError run_time;
    std::size_t begin;  // of its looks,
    std::size_t end;    // and one past their last
  };
  struct Sighting {
    std::uint64_t track_id;
    Detection detection;
  };

  void linearise_anew(const Frame& frame, const FrameView& view, const Projector& projector,
                      const LookMaker& maker, const SharedErrorEstimate& errors, TrackTable& tracks,
                      RecentLooks& recent) const;

  bool is_open_ = true;
  std::vector<Frame> frames_;
  std::vector<Sighting> sightings_;
};

}  // namespace geoloc
