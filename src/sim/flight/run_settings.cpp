// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/flight/run_settings.hpp"

#include <cmath>
#include <stdexcept>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/problems.hpp"
#include "geoloc/sim/flight/random_stream.hpp"
#include "geoloc/sim/flight/scenario.hpp"
#include "geoloc/sim/random.hpp"

namespace geoloc::sim {
namespace {

/// A turn about an axis in body coordinates whose length is the angle.
Eigen::Quaterniond rotation(const Eigen::Vector3d& rotation_vector_rad) {
  const double angle_rad = rotation_vector_rad.norm();
  if (!(angle_rad > 0.0)) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, rotation_vector_rad / angle_rad));
}

Eigen::Vector3d draw_mount_error_deg(const CameraErrors& errors, std::uint64_t run_seed) {
  if (errors.mount_error_deg) return Eigen::Vector3d::Map(errors.mount_error_deg->data());
  Random random(stream_seed(run_seed, RandomStream::kMount));
  Eigen::Vector3d error_deg;
  for (double& angle_deg : error_deg) angle_deg = errors.mount_sigma_deg * random.normal();
  return error_deg;
}

VehicleTime at_seconds(double time_s) {
  return VehicleTime{from_seconds(time_s)};
}

}  // namespace

std::vector<std::string> RunSettings::problems() const {
  Problems found;
  found.require(scenario >= 1 && scenario <= kScenarioCount, "scenario must be 1, 2 or 3");
  found.require(!pair_distance_m || (*pair_distance_m > 0.0 && *pair_distance_m <= 5.0),
                "pair_distance must lie in (0, 5] m");
  found.require(frame_rate_hz > 0.0 && frame_rate_hz <= 1000.0, "frame_rate must lie in (0, 1000] Hz");
  found.require(std::abs(errors.latency_s) <= 10.0, "latency must lie in [-10, 10] s");
  found.require(errors.latency_jitter_s >= 0.0 && errors.latency_jitter_s <= 10.0,
                "jitter must lie in [0, 10] s");
  found.require(std::abs(errors.clock_step_s) <= 10.0, "clock_step must lie in [-10, 10] s");
  found.require(std::abs(errors.late_start_s) <= 10.0, "late_start must lie in [-10, 10] s");
  found.require(errors.mount_sigma_deg >= 0.0 && errors.mount_sigma_deg <= 45.0,
                "mount_sigma must lie in [0, 45] deg");
  found.require(std::abs(errors.focal_percent) <= 50.0, "focal_error must lie in [-50, 50] %");
  if (errors.mount_error_deg) {
    for (const double angle_deg : *errors.mount_error_deg) {
      found.require(std::abs(angle_deg) <= 180.0, "mount_error must lie in [-180, 180] deg");
    }
  }
  for (const std::optional<double>& time_s : {start_s, end_s}) {
    found.require(!time_s || std::abs(*time_s) < 1e7, "start and end must lie within 1e7 s");
  }
  found.add(camera.problems());
  return found.take();
}

std::vector<Eigen::Vector2d> make_targets(const RunSettings& settings) {
  return settings.pair_distance_m ? make_pairs(*settings.pair_distance_m, settings.seed)
                                  : make_scenario(settings.scenario, settings.seed);
}

std::uint64_t run_seed(const RunSettings& settings, const Flight& flight) {
  std::uint64_t hash = 0xcbf29ce484222325U;  // FNV-1a
  const auto add = [&hash](std::uint64_t value) { hash = (hash ^ value) * 0x100000001b3U; };
  for (const char letter : flight.name) add(static_cast<std::uint8_t>(letter));
  add(static_cast<std::uint64_t>(settings.scenario));
  add(settings.seed);
  return hash;
}

TrueCamera make_true_camera(const RunSettings& settings, std::uint64_t run_seed) {
  const Eigen::Vector3d error_deg = draw_mount_error_deg(settings.errors, run_seed);
  // Turned as a whole in the body: at pitch -90 deg the mount's roll and yaw turn about the same axis.
  const Rigid3d nominal = body_from_camera(settings.camera.mount);
  const Eigen::Quaterniond turned = rotation(error_deg * kRadPerDeg) * nominal.rotation;
  CameraIntrinsics intrinsics = settings.camera.intrinsics;
  intrinsics.fx_px *= 1.0 + 0.01 * settings.errors.focal_percent;
  intrinsics.fy_px *= 1.0 + 0.01 * settings.errors.focal_percent;
  return {intrinsics, {turned.normalized(), nominal.translation}, error_deg};
}

CameraModel zoomed(const CameraModel& camera, double zoom) {
  const CameraIntrinsics& wide = camera.intrinsics();
  return camera.with_focal_length({zoom * wide.fx_px, zoom * wide.fy_px});
}

CameraConfig nominal_camera(const RunSettings& settings) {
  CameraConfig camera = settings.camera;
  if (!settings.errors.lens_is_calibrated) camera.intrinsics.distortion = {};
  return camera;
}

TimeSpan run_span(const RunSettings& settings, const Trajectory& truth) {
  const TimeSpan survey = truth.survey();
  const TimeSpan whole = truth.span();
  const TimeSpan asked{settings.start_s ? at_seconds(*settings.start_s) : survey.begin,
                       settings.end_s ? at_seconds(*settings.end_s) : survey.end};
  if (!(asked.begin < asked.end) || asked.begin < whole.begin || asked.end > whole.end) {
    throw std::invalid_argument("start and end must rise and lie within the flight, which has truth from " +
                                std::to_string(seconds(whole.begin.time_since_epoch())) + " s to " +
                                std::to_string(seconds(whole.end.time_since_epoch())) +
                                " s of the vehicle's clock");
  }
  return asked;
}

std::vector<io::TrueTarget> true_targets(const std::vector<Eigen::Vector3d>& positions_in_enu,
                                         const LocalFrame& frame) {
  std::vector<io::TrueTarget> targets;
  for (const Eigen::Vector3d& position_in_enu : positions_in_enu) {
    targets.push_back({static_cast<int>(targets.size()), 0, frame.to_geodetic(position_in_enu.head<2>()),
                       position_in_enu.z()});
  }
  return targets;
}

}  // namespace geoloc::sim
