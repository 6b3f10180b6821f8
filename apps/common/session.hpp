// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "common/estimation_config.hpp"
#include "common/frame_looks.hpp"
#include "common/run_census.hpp"
#include "common/run_history.hpp"
#include "common/state_news.hpp"
#include "geoloc/io/mavlink/vehicle_link.hpp"
#include "geoloc/pipeline/geolocator.hpp"

namespace geoloc::apps {

/// A frame's detections before its time is known on the vehicle's clock.
struct PendingFrame {
  HostTime captured_at;
  std::vector<Detection> detections;
  double time_sigma_s = 0.0;                        ///< 1-sigma of captured_at; 0: not stated
  std::optional<CameraMount> mount = std::nullopt;  ///< of a camera that moves; nullopt: as configured
  /// Focal length [fx, fy] that a camera that zooms tells with the frame; nullopt: it tells none.
  std::optional<Eigen::Vector2d> focal_px = std::nullopt;
};

/// Telemetry bytes and detections in, objects out: what a live run and a replay share. It reads no clock and
/// does no input or output, so that the same calls give the same objects, live or replayed.
class Session final : private io::TelemetrySink {
 public:
  /// A raw MAVLink frame of the link, before it has any effect.
  using OnTelemetry = std::function<void(HostTime received_at, const std::uint8_t* frame, std::size_t size)>;

  /// Throws std::invalid_argument naming every problem.
  explicit Session(const EstimationConfig& config, OnTelemetry on_telemetry = {});

  /// True where the bytes held a frame of the vehicle: their sender is the one to answer.
  bool add_telemetry(HostTime received_at, const std::uint8_t* data, std::size_t size);

  /// Whether the vehicle's state at that time is known, or will never be: there is nothing to wait for.
  bool is_decided(HostTime captured_at) const;

  /// Locates the frame with what is known now. False, and counted, where its state is not known.
  bool process(const PendingFrame& frame);

  /// No more frames come: objects are as good as they get.
  void finish() {
    geolocator_.finish();
    is_finished_ = true;
  }
  bool is_finished() const { return is_finished_; }

  /// Frames given to process(), and those of them that had no state.
  std::uint64_t frames() const { return geolocator_.counters().frames + frames_without_vehicle_; }
  std::uint64_t frames_unusable() const {
    return geolocator_.counters().frames_unusable + frames_without_vehicle_;
  }

  /// How many frames of the run were damaged and so not given to process().
  void note_damaged(std::uint64_t frames) { frames_damaged_ = frames; }
  std::uint64_t frames_damaged() const { return frames_damaged_; }

  /// What a user is to be told of the vehicle, since the last call.
  std::vector<std::string> take_news() { return news_.take(); }

  const Geolocator& geolocator() const { return geolocator_; }
  const RunHistory& history() const { return history_; }
  RunHistory& history() { return history_; }
  const RunCensus& census() const { return census_; }

  /// What became of the detections in the frame located last, one entry for each of Geolocator::located().
  const std::vector<io::Look>& looks() const { return looks_; }
  const io::VehicleLink& link() const { return link_; }
  io::VehicleLink& link() { return link_; }
  Duration max_frame_wait() const { return max_frame_wait_; }

  /// Until when a frame of that stamp is worth waiting for: so long after it was taken, where stamps are
  /// known to be early.
  HostTime gives_up_at(HostTime captured_at) const;

 private:
  void on_attitude(const AttitudeSample& sample) override { take(sample); }
  void on_position(const PositionSample& sample) override;
  void on_range(const RangeSample& sample) override { geolocator_.add(sample); }
  void on_gimbal(const GimbalSample& sample) override;
  void on_field_of_view(const FieldOfViewSample& sample) override { geolocator_.add(sample); }
  void on_reboot() override { geolocator_.on_vehicle_reboot(); }
  void on_other_vehicle() override { begin_anew(); }
  void on_clock_step(Duration change) override;
  void on_frame(HostTime received_at, const std::uint8_t* frame, std::size_t size) override;

  void begin_anew();

  template <typename Sample>
  void take(const Sample& sample) {
    geolocator_.add(sample);
    news_.note(geolocator_.state());
  }

  Duration max_frame_wait_;
  io::VehicleLink link_;
  Geolocator geolocator_;
  RunHistory history_;
  RunCensus census_;
  StateNews news_;
  OnTelemetry on_telemetry_;
  FrameDetections frame_;  // reused
  FrameLooks frame_looks_;
  std::vector<io::Look> looks_;
  bool is_finished_ = false;
  std::uint64_t frames_damaged_ = 0;
  std::uint64_t frames_without_vehicle_ = 0;  // before its clock was known
};

}  // namespace geoloc::apps
