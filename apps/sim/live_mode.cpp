// SPDX-License-Identifier: Apache-2.0
#include "sim/live_mode.hpp"

#include <atomic>
#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <thread>

#include "common/stop_signal.hpp"
#include "geoloc/io/atomic_file.hpp"
#include "geoloc/io/recording/recording_writer.hpp"
#include "geoloc/sim/flight/terrain.hpp"
#include "geoloc/sim/live/camera_telemetry.hpp"
#include "geoloc/sim/live/flight_camera.hpp"
#include "geoloc/sim/live/udp_vehicle.hpp"
#include "geoloc/sim/rtsp/rtsp_camera.hpp"

namespace geoloc::sim {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr double kLeadIn_s = 3.0;    // of the flight, before the survey
constexpr double kSettling_s = 4.0;  // from when both clients are there to the start: clocks get known
constexpr double kLinger_s = 1.0;    // after the flight, for frames and messages under way

/// Begins a little before the survey, where that was not asked for otherwise.
TimeSpan live_span(const RunSettings& settings, const Trajectory& truth) {
  TimeSpan span = run_span(settings, truth);
  if (!settings.start_s) span.begin = std::max(truth.span().begin, span.begin - from_seconds(kLeadIn_s));
  return span;
}

/// Where the simulators of the autopilots send to.
std::string peer(const RunOptions& run, const LiveOptions& options) {
  if (!options.udp.empty()) return options.udp;
  return run.autopilot == "px4" ? "127.0.0.1:14540" : "127.0.0.1:14550";
}

AutopilotManners manners(const RunOptions& run) {
  if (!is_px4(run)) return ardupilot_manners();
  return run.autopilot == "px4" ? px4_onboard_manners() : px4_ground_manners();
}

/// All that a live run is made of; members are in the order in which they depend on each other.
struct LiveRun {
  LiveRun(const RunOptions& run, const LiveOptions& options, std::uint64_t seed)
      : has_sei(run.has_sei),
        settings(to_settings(run, seed)),
        flight(with_moving_camera(load_flight(run), run, settings)),
        targets_in_enu(make_targets(settings)),
        flight_clock(live_span(settings, flight.truth), options.speed),
        vehicle(flight,
                {io::parse_udp_endpoint(peer(run, options)), manners(run), options.link, seed,
                 options.reboot_at_s},
                flight_clock, host_clock),
        camera_telemetry(flight, flight_clock, settings.camera.intrinsics),
        camera(flight, settings, flight_clock, make_run_scene(targets_in_enu, options.distractors, seed)),
        server({options.rtsp_port, settings.camera.intrinsics.width_px, settings.camera.intrinsics.height_px,
                settings.frame_rate_hz}) {}

  bool has_sei;
  RunSettings settings;
  Flight flight;
  std::vector<Eigen::Vector2d> targets_in_enu;
  io::HostClock host_clock;
  FlightClock flight_clock;
  UdpVehicle vehicle;
  CameraTelemetry camera_telemetry;
  FlightCamera camera;
  RtspCamera server;
};

/// Counts since the last status line.
struct Tally {
  int frames = 0;
  int missed = 0;  ///< that could not be drawn in time
  std::uint64_t messages_before = 0;
  SteadyClock::time_point since = SteadyClock::now();
};

void print_status(const LiveRun& run, Tally& tally) {
  const auto now = SteadyClock::now();
  const double elapsed_s = std::chrono::duration<double>(now - tally.since).count();
  const TimeSpan span = run.flight_clock.span();
  const std::uint64_t messages = run.vehicle.messages_sent();
  std::fprintf(stderr, "flight %5.1f / %.1f s%s | video %s %4.1f frames/s%s | telemetry %5.1f msg/s\n",
               seconds(run.flight_clock.flight_time(run.host_clock.at(now)) - span.begin),
               seconds(span.end - span.begin), run.flight_clock.is_released() ? "" : " (waiting)",
               run.server.is_watched() ? "watched" : "unwatched", tally.frames / elapsed_s,
               tally.missed > 0 ? (", " + std::to_string(tally.missed) + " missed: too slow").c_str() : "",
               static_cast<double>(messages - tally.messages_before) / elapsed_s);
  tally = {0, 0, messages, now};
}

/// Decides when the flight starts: a while after video is watched and messages are asked for, which nobody
/// needs where the video tells them, or when waiting is over.
class Starter {
 public:
  Starter(double wait_s, HostTime now) : wait_s_(wait_s), began_at_(now), last_unready_at_(now) {}

  void update(LiveRun& run, HostTime now) {
    const bool is_ready = run.server.is_watched() && (run.has_sei || run.vehicle.has_listener());
    if (!is_ready) last_unready_at_ = now;
    const bool has_settled = seconds(now - last_unready_at_) >= kSettling_s;
    if (has_settled || seconds(now - began_at_) >= wait_s_) run.flight_clock.release(now);
  }

 private:
  double wait_s_;
  HostTime began_at_;
  HostTime last_unready_at_;
};

/// Draws and serves frames at the frame rate until the flight is over.
void film(LiveRun& run, double wait_s, const apps::StopSignal& stop) {
  const std::chrono::nanoseconds period = from_seconds(1.0 / run.settings.frame_rate_hz);
  Starter starter(wait_s, run.host_clock.now());
  Tally tally;
  cv::Mat bgr;
  std::optional<HostTime> over_at;
  for (auto tick = SteadyClock::now(); !stop.is_requested(); tick += period) {
    std::this_thread::sleep_until(tick);
    const HostTime stamp = run.host_clock.at(tick);
    starter.update(run, stamp);
    if (run.server.is_watched()) {
      run.camera.render(run.camera.draw_view(stamp), bgr);
      std::optional<io::VideoTelemetry> telemetry;
      if (run.has_sei) telemetry = run.camera_telemetry.at(stamp);
      if (run.server.push(bgr.data, tick, telemetry)) ++tally.frames;
    }
    for (; SteadyClock::now() - tick > 2 * period; tick += period) ++tally.missed;
    if (SteadyClock::now() - tally.since >= std::chrono::seconds{1}) print_status(run, tally);
    if (!over_at && run.flight_clock.is_over(stamp)) over_at = stamp;
    if (over_at && seconds(stamp - *over_at) >= kLinger_s) return;
  }
}

/// A thread that ends with its scope.
class VehicleThread {
 public:
  explicit VehicleThread(UdpVehicle& vehicle) : thread_([this, &vehicle] { vehicle.run(stop_); }) {}
  ~VehicleThread() {
    stop_ = true;
    thread_.join();
  }

 private:
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

void print_start(const LiveRun& run, const LiveOptions& options, const std::string& udp) {
  std::fprintf(stderr,
               "geoloc_sim: flight %s, scenario %d, seed %llu, speed %g\n"
               "  video     %s%s\n"
               "  MAVLink   to udp %s\n"
               "waiting up to %g s for a viewer%s\n",
               run.flight.name.c_str(), run.settings.scenario,
               static_cast<unsigned long long>(run.settings.seed), options.speed, run.server.url().c_str(),
               run.has_sei ? ", which carries the telemetry, too" : "", udp.c_str(), options.wait_s,
               run.has_sei ? "" : " and for someone who listens to MAVLink");
}

void check(const LiveOptions& options) {
  if (!(options.speed >= 0.1 && options.speed <= 20.0))
    throw std::invalid_argument("--speed must lie in [0.1, 20]");
  if (!(options.wait_s >= 0.0 && options.wait_s <= 1e6))
    throw std::invalid_argument("--wait-s must lie in [0, 1e6]");
  if (!(options.distractors >= 0 && options.distractors <= 1000)) {
    throw std::invalid_argument("--distractors must lie in [0, 1000]");
  }
  if (options.reboot_at_s && !(*options.reboot_at_s >= 0.0 && *options.reboot_at_s <= 1e6)) {
    throw std::invalid_argument("--reboot-at must lie in [0, 1e6] s");
  }
}

}  // namespace

int run_live_mode(const RunOptions& options, const LiveOptions& live, std::uint64_t seed) {
  const apps::StopSignal stop;
  std::unique_ptr<LiveRun> run;
  try {
    check(live);
    run = std::make_unique<LiveRun>(options, live, seed);
    if (!live.truth_file.empty()) {
      const auto truth = true_targets(standing_on({}, run->targets_in_enu), run->flight.truth.frame());
      io::write_file_atomically(live.truth_file, io::truth_to_geojson(truth));
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "geoloc_sim: %s\n", error.what());
    return 2;
  }
  print_start(*run, live, peer(options, live));
  const VehicleThread vehicle(run->vehicle);
  film(*run, live.wait_s, stop);
  std::fputs(stop.is_requested() ? "geoloc_sim: interrupted\n" : "geoloc_sim: the flight is over\n", stderr);
  return 0;
}

}  // namespace geoloc::sim
