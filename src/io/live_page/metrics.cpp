// SPDX-License-Identifier: Apache-2.0
#include "metrics.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <iterator>

namespace geoloc::io {
namespace {

class Metrics {
 public:
  template <typename Number>
  void gauge(const char* name, const char* help, Number value) {
    add(name, help, "gauge", value);
  }
  /// Counts since the run began.
  void counter(const char* name, const char* help, std::uint64_t value) { add(name, help, "counter", value); }
  const std::string& text() const { return text_; }

 private:
  template <typename Number>
  void add(const char* name, const char* help, const char* type, Number value) {
    fmt::format_to(std::back_inserter(text_),
                   "# HELP geoloc_{0} {1}\n# TYPE geoloc_{0} {2}\ngeoloc_{0} {3}\n", name, help, type, value);
  }

  std::string text_;
};

void add_status(const LiveStatus& status, Metrics& metrics) {
  metrics.gauge("run_seconds", "Time since the program began.", seconds(status.elapsed));
  metrics.gauge("telemetry_up", "Whether telemetry comes.", status.link_is_good ? 1 : 0);
  metrics.gauge("video_up", "Whether frames come.", status.video_is_good ? 1 : 0);
  metrics.gauge("attitude_rate_hertz", "Attitudes a second.", status.attitude_rate_hz);
  metrics.gauge("position_rate_hertz", "Positions a second.", status.position_rate_hz);
  metrics.gauge("video_rate_hertz", "Frames a second.", status.video_rate_hz);
  metrics.gauge("detection_seconds", "Mean time that the detector takes for a frame.",
                1e-3 * status.detect_ms);
  metrics.gauge("delay_seconds", "Mean time from a frame's capture to its result.", 1e-3 * status.latency_ms);
  metrics.gauge("objects_tentative", "Objects that are not confirmed yet.", status.tentative);
  metrics.counter("frames_searched_total", "Frames that the detector has searched.", status.frames_searched);
  metrics.counter("frames_dropped_total", "Frames that came while the detector was busy, and went.",
                  status.frames_dropped);
  metrics.counter("video_packets_lost_total", "Packets of the stream that were lost.", status.packets_lost);
}

void add_counters(const RunCounters& counters, Metrics& metrics) {
  metrics.counter("frames_total", "Frames that were processed.", counters.frames);
  metrics.counter("frames_located_total", "Frames that had a vehicle state.", counters.frames_located);
  metrics.counter("frames_unusable_total", "Frames without a vehicle state.", counters.frames_unusable);
  metrics.counter("frames_damaged_total", "Frames that were damaged on their way, and left out.",
                  counters.frames_damaged);
  metrics.counter("detections_total", "Detections in located frames.", counters.detections);
  metrics.counter("attitudes_total", "Attitudes that were taken in.", counters.attitudes);
  metrics.counter("positions_total", "Positions that were taken in.", counters.positions);
  metrics.counter("vehicle_reboots_total", "Times that the vehicle's clock began anew.", counters.reboots);
  metrics.counter("vehicle_clock_steps_total", "Steps of the vehicle's clock.", counters.clock_steps);
  metrics.counter("vehicle_position_steps_total", "Steps of the vehicle's own position.",
                  counters.position_steps);
}

/// What is not finite is left out: a graph has a gap there.
void add_calibration(const Calibration& calibration, Metrics& metrics) {
  const double sigma_s = calibration.sigma(CalibrationIndex::kLatency);
  if (std::isfinite(calibration.latency_s()))
    metrics.gauge("latency_seconds", "A frame shows the world so long before its stamp, as learnt.",
                  calibration.latency_s());
  if (std::isfinite(sigma_s)) metrics.gauge("latency_sigma_seconds", "1-sigma of that.", sigma_s);
}

}  // namespace

std::string metrics_text(const RunFigures& figures) {
  Metrics metrics;
  metrics.gauge("objects", "Confirmed objects.", figures.objects);
  add_counters(figures.estimator.counters, metrics);
  if (figures.estimator.calibration) add_calibration(*figures.estimator.calibration, metrics);
  if (figures.status) add_status(*figures.status, metrics);
  return metrics.text();
}

}  // namespace geoloc::io
