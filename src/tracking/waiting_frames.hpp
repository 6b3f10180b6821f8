// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "tracking/calibrated_viewer.hpp"
#include "tracking/frame_boxes.hpp"
#include "tracking/tracker.hpp"

namespace geoloc {

/// The last frames whose latency is not proven: those used already, and after them those that wait until it
/// is. In order; does not allocate after construction.
class WaitingFrames {
 public:
  static constexpr std::size_t kMost = 512;  ///< fifty seconds at ten frames a second

  explicit WaitingFrames(int max_detections);
  /// geometry/room.hpp
  static std::size_t take_room(WaitingFrames* self, std::size_t max_detections);

  std::size_t size() const { return count_; }
  /// The first ones, that have been used already.
  std::size_t used() const { return used_; }
  const FrameStamp& stamp(std::size_t i) const { return entry(i).stamp; }
  FrameBoxes boxes(std::size_t i) const;
  /// The stamp of the last frame that is here no more.
  std::optional<HostTime> left_at() const { return left_at_; }

  /// Makes room for one more: of those used, the oldest goes. False where all wait.
  bool make_room();

  /// There must be room. is_held: with all that were held before it, until one comes that is not.
  void add(const LocatedFrame& frame, bool is_held);

  /// None is held any more.
  void release() { held_ = 0; }

  /// Frames that wait and are not held.
  std::size_t due() const { return count_ - used_ - held_; }

  /// The oldest one that waits, seen from where it is now believed to have been; nullopt where that is not
  /// known. It counts as used. `newest`: what frames refer to.
  std::optional<LocatedFrame> use_next(const LocatedFrame& newest, const SharedErrorEstimate& errors);

  /// The one just added has been used.
  void count_newest_as_used() { ++used_; }

  /// Those used are proven.
  void drop_used();

  /// All from that one on wait again: they were used with a wrong latency. Those before it are dropped.
  void use_again_from(std::size_t first);

 private:
  struct Entry {
    FrameStamp stamp;
    std::optional<double> range_m;
    std::size_t begin = 0;       // of its detections in the ring,
    std::size_t detections = 0;  // and how many
  };
  bool is_full() const;
  void drop_oldest();
  const Entry& entry(std::size_t i) const { return entries_[(begin_ + i) % entries_.size()]; }

  std::vector<Entry> entries_;  // a ring
  std::size_t begin_ = 0;
  std::size_t count_ = 0;
  std::optional<HostTime> left_at_;
  std::size_t used_ = 0;               // the first ones
  std::size_t held_ = 0;               // the last ones
  std::vector<Detection> detections_;  // a ring: those of all entries
  std::size_t detection_end_ = 0;
  std::size_t detection_count_ = 0;
  std::size_t max_detections_;
  FrameView view_;
  std::vector<LocatedDetection> located_;
};

}  // namespace geoloc
