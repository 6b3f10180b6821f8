// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "geoloc/pipeline/geolocator.hpp"
#include "geoloc/projection/ground_model.hpp"
#include "geoloc/projection/projector.hpp"
#include "geoloc/state/state_buffer.hpp"
#include "geoloc/state/state_provider.hpp"
#include "pipeline/frame_queue.hpp"
#include "pipeline/kept_frame.hpp"
#include "pipeline/zoom_scale.hpp"
#include "projection/frame_viewer.hpp"
#include "tracking/tracker.hpp"

namespace geoloc {

class Geolocator::Implementation {
 public:
  explicit Implementation(const GeolocatorConfig& given);
  /// geometry/room.hpp
  static std::size_t take_room(Implementation* self, const GeolocatorConfig& config);

  std::optional<NoState> missing_state(VehicleTime captured_at) const;

  void add(const RangeSample& sample);
  void add(const GimbalSample& sample);
  void add(const FieldOfViewSample& sample);
  std::optional<FrameOutcome> add(const FrameDetections& frame);
  std::optional<FrameOutcome> process_next(FrameWait wait);
  bool process(const FrameDetections& frame);
  void finish();

  const GeolocatorConfig config;
  StateProvider state;
  const FrameViewer viewer;
  const Projector projector;
  GroundModel ground;  // level until the vehicle's first position
  std::unique_ptr<Tracker> tracker;
  FrameView view;
  std::vector<LocatedDetection> located;
  Counters counters;
  FrameQueue waiting;

 private:
  VehicleTime believed_time(VehicleTime captured_at) const {
    return captured_at - from_seconds(tracker->calibration().latency_s());
  }
  void begin_map_anew();
  void take(const FrameDetections& frame);
  bool is_forgotten(const KeptFrame& frame) const { return frame.clock_epoch != state.clock_epoch(); }
  bool is_late(const KeptFrame& frame) const;
  bool must_wait(const KeptFrame& frame) const;
  FrameFate process_waiting(const KeptFrame& frame);
  FrameFate locate(const KeptFrame& frame);
  FrameOutcome count(const FrameStamp& stamp, FrameFate fate);

  std::optional<double> range_at(VehicleTime time) const;
  void anchor_state(VehicleTime captured_at);
  FrameView lifted(FrameView nominal_view) const;
  void locate(const std::vector<Detection>& detections, const FrameView& from,
              std::vector<LocatedDetection>& found, decltype(Counters::no_fix)& no_fix) const;
  LocatedFrame located_frame(const FrameStamp& stamp, const FrameView& from,
                             const std::vector<LocatedDetection>& detections) const;
  void track_either_way(const KeptFrame& frame);
  bool may_be_turned(const FrameStamp& stamp);

  ZoomScale zoom_;
  StateBuffer<double> ranges_;
  std::uint64_t reboots_ = 0;                                            // when ranges_ was begun
  bool has_object_ = false;                                              // a confirmed one
  KeptFrame taken_;                                                      // the frame given last
  std::optional<FrameStamp> last_stamp_;                                 // of the frames located
  std::optional<std::pair<std::uint64_t, VehicleTime>> last_processed_;  // its clock's epoch, and its time
  std::vector<LocatedDetection> turned_located_;                         // scratch of track_either_way
};

}  // namespace geoloc
