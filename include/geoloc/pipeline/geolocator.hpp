// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/calibration/calibration.hpp"
#include "geoloc/camera/detection.hpp"
#include "geoloc/geometry/expected.hpp"
#include "geoloc/pipeline/frame_outcome.hpp"
#include "geoloc/pipeline/geolocator_config.hpp"
#include "geoloc/projection/ground_fix.hpp"
#include "geoloc/state/samples.hpp"
#include "geoloc/state/vehicle_state.hpp"
#include "geoloc/tracking/joint_estimate.hpp"
#include "geoloc/tracking/known_points.hpp"
#include "geoloc/tracking/track.hpp"

namespace geoloc {

class GroundModel;
class Projector;
class StateProvider;

/// The whole estimator, and the one class that an autopilot links: telemetry and detections in, objects out.
///
/// It has no clock, no thread and no lock: one owner calls it, and the same calls give the same bits. It
/// does not allocate after construction.
class Geolocator {
 public:
  struct Counters {
    std::uint64_t frames = 0;                                 ///< those that wait are not among them yet
    std::uint64_t frames_located = 0;                         ///< that had a vehicle state
    std::uint64_t frames_unusable = 0;                        ///< all others
    std::array<std::uint64_t, kFrameFates> frames_by_fate{};  ///< by FrameFate
    std::uint64_t detections = 0;                             ///< in located frames
    std::uint64_t detections_dropped = 0;  ///< beyond max_detections, or with numbers that cannot be
    std::uint64_t maps_void = 0;           ///< objects begun anew, since a gimbal was misread
    std::uint64_t ranges = 0;              ///< a rangefinder's readings that were taken in
    std::uint64_t detections_at_edge = 0;  ///< not used: cut by the image's edge, perhaps
    std::array<std::uint64_t, kNoFixReasons> no_fix{};  ///< detections without a ground point, by NoFix
  };

  /// Every problem of the configuration where it has any. Software without exceptions begins so.
  static Expected<Geolocator, std::vector<std::string>> create(const GeolocatorConfig& config);

  /// Throws std::invalid_argument naming every problem of the configuration (refuse.hpp).
  explicit Geolocator(const GeolocatorConfig& config);
  ~Geolocator();
  Geolocator(Geolocator&&) noexcept;
  Geolocator& operator=(Geolocator&&) noexcept;

  /// What one of this configuration asks of the heap at construction, and holds from then on [bytes], without
  /// what the heap adds of its own to each of some hundred blocks. Takes none of it. Refuses what the
  /// constructor refuses. A terrain is its owner's.
  static std::size_t memory_needed(const GeolocatorConfig& config);

  /// Samples may come in any order and at any rate; what cannot be used is counted (state().counters()).
  void add(const AttitudeSample& sample);
  void add(const PositionSample& sample);
  void add(const RangeSample& sample);

  /// Used where the camera's mount is of kind gimbal. Where turns of the vehicle show that yaws count from
  /// the nose instead of north, or the other way round, and where angles turn out to be no measurements, the
  /// objects so far are void and begin anew (counters().maps_void).
  void add(const GimbalSample& sample);

  /// What a camera that zooms says of it: frames that tell no focal length themselves are located with the
  /// one at their time, and wait for it where samples come regularly. Fields of view are scaled so that one
  /// that stands still within 5 % of the calibration's is that.
  void add(const FieldOfViewSample& sample);

  /// A frame waits, at least until there are attitudes and positions from beyond its time, and the gimbal's
  /// angles where the camera is on one; process_next() then locates it. Frames may be added in any order
  /// while they wait. At most 64 do: beyond, the latest one goes, and is returned.
  std::optional<FrameOutcome> add(const FrameDetections& frame);

  /// Locates the next frame that waits no longer, and refines the objects with it: to be called until it
  /// returns nullopt, which is that no frame is ready. located() and view() are this frame's then, where it
  /// could be located. Where a vehicle's state at its time is not known, nothing is guessed: its fate tells
  /// why.
  [[nodiscard]] std::optional<FrameOutcome> process_next(FrameWait wait = FrameWait::kForTelemetry);

  std::size_t frames_waiting() const;

  /// The vehicle's clock began anew. Needed only where the caller knows before three samples have shown it.
  void on_vehicle_reboot();

  /// The vehicle's clock stepped against the clock that frames are stamped by: samples from before the step
  /// cannot be told apart in time from those after it.
  void on_vehicle_clock_step();

  /// Whether process() could locate a frame of that time now (nullopt), or why not. On NoState::kNotYet it is
  /// worth waiting.
  std::optional<NoState> missing_state(VehicleTime captured_at) const;

  /// In place of add() and process_next(), for callers whose frames wait elsewhere: locates a frame at once.
  /// Frames in order of their time. False, and counted, where it could not be located.
  [[nodiscard]] bool process(const FrameDetections& frame);

  /// No more frames and telemetry come: frames that wait are processed with what is known. Where a clock may
  /// have stepped, the objects' estimator holds frames back, too, for 12 s at most: they are used now. The
  /// flight may go on afterwards.
  void finish();

  /// All objects, tentative and confirmed, in order of their ids.
  const std::vector<Track>& tracks() const;

  /// The last located frame: every detection that met the ground, the state and the camera's pose it was
  /// located with.
  const std::vector<LocatedDetection>& located() const;
  const FrameView& view() const;

  /// What was learnt of the constant errors; nullopt where the method learns none.
  std::optional<Calibration> calibration() const;

  /// The confirmed objects at rest with what they are off by together, for fusion with other flights
  /// (summarize()); nullopt where the method does not know it, and before the first frame. Costs a solution
  /// and allocates; the estimator goes on as if it had not been asked.
  std::optional<JointEstimate> joint_estimate() const;

  /// What became of the known points, in the order of the configuration; empty where the method uses none.
  const std::vector<KnownPointMatch>& known_points() const;

  /// The frame of all positions; set by the first position of the vehicle.
  const std::optional<LocalFrame>& local_frame() const;

  const GeolocatorConfig& config() const;
  const StateProvider& state() const;
  const Projector& projector() const;

  /// Its heights count from the projector's plane. Level until the vehicle's first position is known.
  const GroundModel& ground() const;
  const TrackCounters& track_counters() const;
  const Counters& counters() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace geoloc
