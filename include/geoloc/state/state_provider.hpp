// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "geoloc/geometry/geodetic.hpp"
#include "geoloc/state/boot_clock_monitor.hpp"
#include "geoloc/state/gimbal_history.hpp"
#include "geoloc/state/home_datum.hpp"
#include "geoloc/state/samples.hpp"
#include "geoloc/state/state_buffer.hpp"
#include "geoloc/state/step_watch.hpp"
#include "geoloc/state/turn_rates.hpp"
#include "geoloc/state/vehicle_state.hpp"
#include "geoloc/state/with_steps.hpp"
#include "geoloc/state/zoom_history.hpp"

namespace geoloc {

/// Position in the local frame with the turn of true north there.
struct LocalPosition {
  Eigen::Vector3d position_in_enu = Eigen::Vector3d::Zero();
  double convergence_rad = 0.0;
};

template <>
struct Interpolator<LocalPosition> {
  static LocalPosition between(const LocalPosition& before, const LocalPosition& after, double alpha) {
    return {before.position_in_enu + alpha * (after.position_in_enu - before.position_in_enu),
            before.convergence_rad + alpha * (after.convergence_rad - before.convergence_rad)};
  }
};

/// Interpolates the asynchronous position and attitude of the vehicle (paper, section 3.2). The local frame's
/// origin is the first position. Where the next one lies farther from it than any vehicle goes in the time
/// between, one of the two is false: the frame begins anew, until two agree. A reboot of the vehicle empties
/// the buffers; the frame stays.
///
/// Where the vehicle's own state steps, states go on as before the step, and there is none between the two
/// samples. Heights are above the first home.
class StateProvider {
 public:
  struct Counters {
    std::uint64_t attitudes = 0;       ///< taken in
    std::uint64_t positions = 0;       ///< taken in
    std::uint64_t gimbals = 0;         ///< taken in
    std::uint64_t focal_lengths = 0;   ///< taken in
    std::uint64_t duplicates = 0;      ///< same time as a sample before
    std::uint64_t stale = 0;           ///< older than all that is kept, or late where the state steps
    std::uint64_t invalid = 0;         ///< not finite, no place on Earth, or no rotation
    std::uint64_t out_of_range = 0;    ///< angles that no attitude has: degrees in place of radians, perhaps
    std::uint64_t too_far = 0;         ///< beyond the reach of one local frame
    std::uint64_t unconfirmed = 0;     ///< at the start, with which the next one did not agree
    std::uint64_t suspect_stamps = 0;  ///< far from the others' times
    std::uint64_t reboots = 0;
    std::uint64_t home_moves = 0;      ///< after the take-off
    std::uint64_t position_steps = 0;  ///< horizontally
    std::uint64_t height_steps = 0;
    std::uint64_t yaw_steps = 0;
    std::uint64_t clock_steps = 0;
  };

  /// Throws std::invalid_argument naming every problem.
  explicit StateProvider(const StateConfig& config);

  void add(const AttitudeSample& sample);
  void add(const PositionSample& sample);
  void add(const GimbalSample& sample);
  /// What a camera that zooms told of that time: [fx, fy], finite and positive.
  void add_focal_length(VehicleTime time, const Eigen::Vector2d& focal_px);

  Expected<VehicleState, NoState> at(VehicleTime time) const;

  /// How the gimbal held its camera at the state's time.
  Expected<GimbalState, NoState> gimbal_at(const VehicleState& vehicle) const;

  /// Whether both quantities have samples from beyond that time: later ones do not change at() any more.
  bool is_settled(VehicleTime time) const {
    return positions_.reaches_beyond(time) && attitudes_.reaches_beyond(time);
  }

  /// The gimbal's samples, and what was noticed of them.
  const GimbalHistory& gimbal() const { return gimbal_; }

  /// The camera's zoom.
  const ZoomHistory& zoom() const { return zoom_; }

  /// Whether how far the camera had zoomed in at that time is as well known as it will be: of a camera that
  /// has stopped telling it, nothing is waited for.
  bool is_zoom_settled(VehicleTime time) const {
    const auto due = zoom_.due_after(time);
    return !due || attitudes_.reaches_beyond(*due);
  }

  /// Rises where the vehicle's clock begins anew or steps: what times of before meant is not known since.
  std::uint64_t clock_epoch() const { return counters_.reboots + counters_.clock_steps; }

  /// States from now on, also those of earlier times, go on from the one of that time: for as long as nothing
  /// hangs on the ones before, since the newest are more often right.
  void anchor(VehicleTime time);

  /// Forgets all samples: for callers who know of a reboot before the stamps show it.
  void restart();

  /// The vehicle's clock stepped: as much time lies between the samples so far and the next ones as nobody
  /// knows, so that those so far are forgotten.
  void on_clock_step();

  /// Set by the first position, for good by one that agrees with it.
  const std::optional<LocalFrame>& local_frame() const { return frame_; }

  /// Something was located: the frame stays where it is.
  void keep_frame();

  /// What becomes of positions now.
  enum class PositionUse {
    kNone,         ///< none has come
    kUnconfirmed,  ///< the last one began the local frame and waits for another that agrees
    kTooFar,       ///< the last one lies beyond the reach of the local frame
    kTaken
  };
  PositionUse position_use() const { return position_use_; }

  /// So many positions in a row were beyond the reach of the local frame.
  std::uint64_t too_far_in_a_row() const { return too_far_in_a_row_; }

  /// Height of home above mean sea level, as of the first position; nullopt where that told none.
  const std::optional<double>& home_height_msl_m() const { return home_height_msl_m_; }
  /// Where home is now, and where the first one was.
  const HomeDatum& home() const { return home_; }

  /// All steps noticed so far.
  StateSteps steps() const;

  Counters counters() const;

 private:
  struct Brackets {
    Bracket<WithSteps<LocalPosition>> position;
    Bracket<WithSteps<AttitudeSample>> attitude;
  };

  bool accept_stamp(VehicleTime stamp);
  void judge_beginning(const PositionSample& second);
  void begin_frame(const PositionSample& first);
  void take(const PositionSample& sample);
  Expected<Brackets, NoState> brackets(VehicleTime time) const;
  void forget_samples();
  void compare_with_vehicle(const GimbalSample& gimbal);

  StateConfig config_;
  std::optional<LocalFrame> frame_;
  std::optional<PositionSample> unconfirmed_;  // the one that began the frame, until another agrees
  PositionUse position_use_ = PositionUse::kNone;
  std::uint64_t too_far_in_a_row_ = 0;
  std::optional<double> home_height_msl_m_;
  HomeDatum home_;
  StepWatch watch_;
  StateBuffer<WithSteps<AttitudeSample>> attitudes_;
  TurnRates turn_rates_;
  StateBuffer<WithSteps<LocalPosition>> positions_;
  GimbalHistory gimbal_;
  ZoomHistory zoom_;
  std::optional<GimbalSample>
      newest_gimbal_;  // to be compared once the vehicle's attitude around it is known
  StateSteps anchor_;
  std::optional<double> sigma_horizontal_m_;
  BootClockMonitor boot_clock_;
  Counters counters_;
};

}  // namespace geoloc
