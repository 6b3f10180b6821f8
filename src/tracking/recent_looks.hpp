// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "calibration/landmark.hpp"
#include "tracking/look.hpp"
#include "tracking/track_table.hpp"

namespace geoloc {

/// The looks of the last seconds as they were added to their objects' sums, so that they can be taken out
/// again where it turns out that they were placed wrongly. Does not allocate after construction.
class RecentLooks {
 public:
  explicit RecentLooks(int max_looks_per_frame);
  /// geometry/room.hpp
  static std::size_t take_room(RecentLooks* self, int max_looks_per_frame);

  void add(std::uint64_t track_id, VehicleTime time, const Look& look);

  /// The look is in the track's sums no more.
  void forget(std::uint64_t track_id, const LandmarkObservation& observation);

  /// Track `gone` is now called `kept`.
  void rename(std::uint64_t gone, std::uint64_t kept);

  /// Takes the looks since then out of the sums of every object that earlier ones are in, too.
  void take_out(VehicleTime since, const DriftTimeline& drift, TrackTable& tracks);

  void clear() { size_ = next_ = 0; }

 private:
  struct Entry {
    std::uint64_t track_id;  // 0: forgotten
    VehicleTime time;
    LandmarkObservation observation;
    Eigen::Matrix2d pixel_noise;
  };

  std::vector<Entry> entries_;  // a ring
  std::size_t next_ = 0;
  std::size_t size_ = 0;
};

}  // namespace geoloc
