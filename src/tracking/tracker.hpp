// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "geoloc/calibration/calibration.hpp"
#include "geoloc/geometry/geodetic.hpp"
#include "geoloc/projection/ground_fix.hpp"
#include "geoloc/projection/ground_model.hpp"
#include "geoloc/projection/projector.hpp"
#include "geoloc/tracking/joint_estimate.hpp"
#include "geoloc/tracking/known_points.hpp"
#include "geoloc/tracking/track.hpp"
#include "projection/frame_viewer.hpp"

namespace geoloc {

/// A frame whose detections are located: what a tracker learns from.
struct LocatedFrame {
  /// In a canonical order (see Geolocator), located with the tracker's calibration() applied.
  const std::vector<LocatedDetection>& detections;
  const Projector& projector;
  const FrameView& view;
  const LocalFrame& local_frame;  ///< of all positions; the same throughout a flight
  FrameStamp stamp;
  const FrameViewer& viewer;  ///< made `view`
  const GroundModel& ground;
  std::optional<double> range_m;  ///< a rangefinder's distance down the body's axis at the view's time
  /// The same frame, were the vehicle's yaw 180 deg from what it tells; nullptr where it cannot be.
  const LocatedFrame* turned = nullptr;
};

/// Makes objects of the fixes of one frame after another.
class Tracker {
 public:
  Tracker() = default;
  virtual ~Tracker() = default;
  Tracker(const Tracker&) = delete;
  Tracker& operator=(const Tracker&) = delete;

  /// Where counters().frames_turned rises, `frame.turned` was taken in its place.
  virtual void update(const LocatedFrame& frame) = 0;

  /// No more frames come: those that wait for what later ones would tell are used. `last`: the newest one.
  virtual void finish(const LocatedFrame& last) { (void)last; }

  /// Tentative and confirmed, in order of their ids.
  virtual const std::vector<Track>& tracks() const = 0;
  virtual const TrackCounters& counters() const = 0;

  /// What fixes are to be located with: the camera's constant errors and those of the autopilot's state in
  /// one. Zero where the method learns none.
  virtual const Calibration& calibration() const = 0;

  /// By how much the camera is to be lifted so that the ground lies in the projector's plane [m], where the
  /// vehicle reports it to be so high above the ground. Zero where the method learns no height.
  virtual double lift_m(double reported_height_above_ground_m) const = 0;

  /// An estimate of the camera's errors alone: the autopilot's own are part of its sigma. nullopt where the
  /// method learns none.
  virtual std::optional<Calibration> calibration_of_camera() const = 0;

  /// The objects at rest with what they are off by together; nullopt where the method does not know it. The
  /// estimator is as if it had not been asked. `ground_height_above_home_m`: the projector's.
  virtual std::optional<JointEstimate> estimate(double ground_height_above_home_m) const {
    (void)ground_height_above_home_m;
    return std::nullopt;
  }

  /// In the order of the configuration; empty where the method uses none.
  virtual const std::vector<KnownPointMatch>& known_points() const = 0;
};

}  // namespace geoloc
