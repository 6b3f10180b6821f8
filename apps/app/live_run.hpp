// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>

#include "app/detection_worker.hpp"
#include "app/recorder.hpp"
#include "app/running_mean.hpp"
#include "app/stamp_sigma.hpp"
#include "app/vehicle_reports.hpp"
#include "common/session.hpp"
#include "geoloc/io/mavlink/link_guard.hpp"
#include "geoloc/io/mavlink/udp_socket.hpp"

namespace geoloc::apps {

/// The loop that owns the estimator: takes telemetry from a socket and detections from a worker, and gives
/// each frame to the session once the vehicle's state around it is known, or the wait for that is over.
class LiveRun {
 public:
  struct Stats {
    std::uint64_t out_of_order =
        0;  ///< frames captured before one that was processed already, or in the future
    std::uint64_t overflowed = 0;  ///< frames that waited while too many others came
    RunningMean latency_s;         ///< from capture to result
    io::TimeQuality time_quality = io::TimeQuality::kArrival;  ///< of the last frame
  };

  /// After each frame, with what the session answered.
  using OnFrame = std::function<void(const PendingFrame& frame, bool is_located)>;

  /// All must outlive the run.
  LiveRun(Session& session, io::UdpSocket& socket, io::LinkGuard& guard, DetectionWorker& worker,
          Recorder& recorder, VehicleReports& reports, const io::HostClock& clock, OnFrame on_frame);

  /// One turn: waits some milliseconds for telemetry at most.
  void step();

  /// The video has ended and no frame waits.
  bool has_ended() const { return worker_.has_ended() && waiting_.empty(); }

  const Stats& stats() const { return stats_; }
  const io::LinkGuard& guard() const { return guard_; }

 private:
  struct WaitingFrame {
    DetectedFrame detected;
    double time_sigma_s;
  };

  void receive_telemetry();
  void send(const std::uint8_t* frame, std::size_t size);
  void take_frames();
  void process_ready();
  void process(const WaitingFrame& frame);

  Session& session_;
  io::UdpSocket& socket_;
  io::LinkGuard& guard_;
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
