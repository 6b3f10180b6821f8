// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>

#include "app/delay_quantiles.hpp"
#include "app/detection_worker.hpp"
#include "app/recorder.hpp"
#include "app/running_mean.hpp"
#include "app/stamp_sigma.hpp"
#include "app/telemetry_input.hpp"
#include "app/vehicle_reports.hpp"
#include "common/session.hpp"

namespace geoloc::apps {

/// The loop that owns the estimator: takes telemetry and the detections of a worker, and gives each frame to
/// the session once the vehicle's state around it is known, or the wait for that is over.
class LiveRun {
 public:
  struct Stats {
    std::uint64_t out_of_order =
        0;  ///< frames captured before one that was processed already, or in the future
    std::uint64_t overflowed = 0;  ///< frames that waited while too many others came
    std::uint64_t untold = 0;      ///< frames without telemetry, where that is the video's
    RunningMean latency_s;         ///< from capture to result, of late
    FrameDelays delays;            ///< of frames that were located
    io::TimeQuality time_quality = io::TimeQuality::kArrival;  ///< of the last frame
  };

  /// After each frame, with what the session answered.
  using OnFrame = std::function<void(const PendingFrame& frame, bool is_located)>;

  /// All must outlive the run.
  LiveRun(Session& session, TelemetryInput& telemetry, DetectionWorker& worker, Recorder& recorder,
          VehicleReports& reports, const io::HostClock& clock, OnFrame on_frame);

  /// One turn: waits some milliseconds for telemetry at most.
  void step();

  /// The video has ended and no frame waits.
  bool has_ended() const { return worker_.has_ended() && waiting_.empty(); }

  const Stats& stats() const { return stats_; }

 private:
  struct WaitingFrame {
    DetectedFrame detected;
    double time_sigma_s;
  };

  void answer_vehicle();
  void take_frames();
  bool stamp_by_telemetry(DetectedFrame& frame);
  void wait_for_state(DetectedFrame frame);
  void process_ready();
  void process(const WaitingFrame& frame);
  void note_delays(const DetectedFrame& frame);

  Session& session_;
  TelemetryInput& telemetry_;
  DetectionWorker& worker_;
  Recorder& recorder_;
  VehicleReports& reports_;
  const io::HostClock& clock_;
  OnFrame on_frame_;
  std::deque<WaitingFrame> waiting_;
  StampSigma stamp_sigma_;
  HostTime newest_captured_{};
  Stats stats_;
};

}  // namespace geoloc::apps
