// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "geoloc/pipeline/geolocator.hpp"

/// A flight whose telemetry and boxes are written out in closed form, so that no error of the library's own
/// geometry can cancel in a test.
namespace geoloc::testing {

constexpr double kFocal_px = 914.01;
constexpr int kImageWidth_px = 1280, kImageHeight_px = 720;
constexpr double kPrincipalX_px = 639.5, kPrincipalY_px = 359.5;

inline VehicleTime at_s(double time_s) {
  return VehicleTime{from_seconds(time_s)};
}

/// The host's clock is a billion seconds ahead.
inline HostTime host_at_s(double time_s) {
  return HostTime{from_seconds(1e9 + time_s)};
}

/// The vehicle's position (east, north, up) [m] and Euler angles [rad].
struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double roll = 0.0, pitch = 0.0, yaw = 0.0;
};

/// Pixel of a point (east, north, up): the camera looks along the body's down axis, its top towards the nose,
/// from the vehicle's position. The body's axes are the columns of Rz(yaw) Ry(pitch) Rx(roll) in
/// north-east-down, written out.
inline std::optional<Eigen::Vector2d> pixel_of_point(const Eigen::Vector3d& place, const Pose& pose) {
  const double cr = std::cos(pose.roll), sr = std::sin(pose.roll);
  const double cp = std::cos(pose.pitch), sp = std::sin(pose.pitch);
  const double cy = std::cos(pose.yaw), sy = std::sin(pose.yaw);
  const double north = place.y() - pose.position.y(), east = place.x() - pose.position.x();
  const double down = pose.position.z() - place.z();
  const double along_nose = cp * cy * north + cp * sy * east - sp * down;
  const double along_right =
      (sr * sp * cy - cr * sy) * north + (sr * sp * sy + cr * cy) * east + sr * cp * down;
  const double along_belly =
      (cr * sp * cy + sr * sy) * north + (cr * sp * sy - sr * cy) * east + cr * cp * down;
  if (along_belly <= 0.0) return std::nullopt;
  return Eigen::Vector2d(kPrincipalX_px + kFocal_px * along_right / along_belly,
                         kPrincipalY_px - kFocal_px * along_nose / along_belly);
}

/// Pixel of a ground point at height 0.
inline std::optional<Eigen::Vector2d> pixel_of(const Eigen::Vector2d& place, const Pose& pose) {
  return pixel_of_point({place.x(), place.y(), 0.0}, pose);
}

/// The box of that size around a pixel, whose centre is at integers (half a pixel from its edges).
inline Detection box_at(const Eigen::Vector2d& pixel, double size_px = 36.0, int class_id = 0) {
  return {
      {pixel.x() + 0.5 - 0.5 * size_px, pixel.y() + 0.5 - 0.5 * size_px, size_px, size_px}, 0.9, class_id};
}

/// Near the origin of the flight, by the radii of curvature of the WGS84 ellipsoid: true to a tenth of a
/// millimetre within 200 m.
inline Geodetic geodetic_of(const Eigen::Vector2d& place) {
  constexpr double kDegree = 3.14159265358979323846 / 180.0;
  constexpr double kEquator_m = 6378137.0, kFlattening = 1.0 / 298.257223563;
  constexpr double kSquaredEccentricity = kFlattening * (2.0 - kFlattening);
  constexpr double kLatitude_deg = -22.906, kLongitude_deg = -43.133, kHomeHeight_m = 10.0;
  const double sine = std::sin(kLatitude_deg * kDegree);
  const double w = std::sqrt(1.0 - kSquaredEccentricity * sine * sine);
  const double meridian_m = kEquator_m * (1.0 - kSquaredEccentricity) / (w * w * w) + kHomeHeight_m;
  const double latitude_deg = kLatitude_deg + place.y() / meridian_m / kDegree;
  const double across_m = (kEquator_m / w + kHomeHeight_m) * std::cos(latitude_deg * kDegree);
  return {latitude_deg, kLongitude_deg + place.x() / across_m / kDegree};
}

/// What the vehicle reports of a pose.
inline PositionSample position_sample(double time_s, const Pose& pose) {
  PositionSample position;
  position.time = at_s(time_s);
  position.position = geodetic_of(pose.position.head<2>());
  position.height_above_home_m = pose.position.z();
  position.height_msl_m = pose.position.z() + 10.0;
  return position;
}
inline AttitudeSample attitude_sample(double time_s, const Pose& pose) {
  return {at_s(time_s), {pose.roll, pose.pitch, pose.yaw}};
}

using Path = std::function<Pose(double time_s)>;

/// To the north and back at up to 5 m/s, in gusts.
inline Pose in_gusts(double time_s) {
  const double north_m = 20.0 * std::sin(0.25 * time_s - 1.5) - 20.0 * std::sin(-1.5);
  return {{0.0, north_m, 20.0},
          0.05 * std::sin(0.9 * time_s) + 0.02 * std::sin(2.3 * time_s),
          0.03 * std::sin(1.3 * time_s),
          0.0};
}

inline Path hovering_at(const Eigen::Vector3d& position) {
  return [=](double) { return Pose{position, 0.0, 0.0, 0.0}; };
}

/// Level and to the north, from the origin at time 0.
inline Path northwards(double speed_mps, double height_m = 20.0) {
  return [=](double time_s) { return Pose{{0.0, speed_mps * time_s, height_m}, 0.0, 0.0, 0.0}; };
}

/// The vehicle and the camera are known, only the detector is noisy, and nothing is left to learn but the
/// objects.
inline GeolocatorConfig noisy_by_the_detector_alone() {
  GeolocatorConfig config;
  JointTrackerConfig& joint = config.joint;
  joint.prior.sigma_boresight_x_deg = joint.prior.sigma_boresight_y_deg = 0.0;
  joint.prior.sigma_boresight_z_deg = joint.prior.sigma_latency_s = joint.prior.sigma_height_m = 0.0;
  joint.prior.sigma_position_lag_s = 0.0;
  joint.drift.sigma_up_m = 1e-6;
  joint.drift.sigma_yaw_deg = 1e-6;
  joint.sigma_attitude_deg = 1e-6;
  joint.sigma_time_s = 0.0;
  joint.horizontal_accuracy_m = 1e-6;
  joint.stated_offset_sigma_m = joint.least_offset_sigma_m = 0.0;
  joint.fast_share = 0.0;
  return config;
}

/// A Geolocator that is told `reported` ten times a second, of a vehicle that is at `truth`. The origin of
/// its frame is where the vehicle reports to be at time 0, which must be the east-north origin.
class NadirFlight {
 public:
  NadirFlight(const GeolocatorConfig& config, Path reported, Path truth)
      : geolocator_(config), reported_(std::move(reported)), truth_(std::move(truth)) {}
  NadirFlight(const GeolocatorConfig& config, const Path& path) : NadirFlight(config, path, path) {}

  /// What the receiver claims its accuracy to be from now on.
  void set_accuracy(std::optional<double> sigma_m) { accuracy_m_ = sigma_m; }

  /// Telemetry for frames up to that time, and a second on.
  void fly_until(double time_s) {
    for (; 0.1 * samples_ < time_s + 1.0; ++samples_) {
      const double sample_s = 0.1 * samples_;
      const Pose pose = reported_(sample_s);
      PositionSample position = position_sample(sample_s, pose);
      position.sigma_horizontal_m = accuracy_m_;
      geolocator_.add(position);
      geolocator_.add(attitude_sample(sample_s, pose));
    }
  }

  /// Where the image shows a place; nullopt within `margin_px` of its edge, and outside.
  std::optional<Eigen::Vector2d> shown(double time_s, const Eigen::Vector2d& place,
                                       double margin_px = 20.0) const {
    return shown_point(time_s, {place.x(), place.y(), 0.0}, margin_px);
  }

  /// The same of a point (east, north, up).
  std::optional<Eigen::Vector2d> shown_point(double time_s, const Eigen::Vector3d& place,
                                             double margin_px = 20.0) const {
    const auto pixel = pixel_of_point(place, truth_(time_s));
    const auto is_inside = [&](double value, double length) {
      return value + 0.5 >= margin_px && value + 0.5 <= length - margin_px;
    };
    if (!pixel || !is_inside(pixel->x(), kImageWidth_px) || !is_inside(pixel->y(), kImageHeight_px))
      return {};
    return pixel;
  }

  bool process(double time_s, std::vector<Detection> detections) {
    fly_until(time_s);
    FrameDetections frame;
    frame.captured_at = at_s(time_s);
    frame.captured_at_host = host_at_s(time_s);
    frame.time_sigma_s = 1e-9;  // the stamp is stated to be right, from the first frame on
    frame.detections = std::move(detections);
    return geolocator_.process(frame);
  }

  /// A perfect detector's frame.
  bool see(double time_s, const std::vector<Eigen::Vector2d>& places, double size_px = 36.0,
           int class_id = 0) {
    std::vector<Detection> detections;
    for (const Eigen::Vector2d& place : places) {
      if (const auto pixel = shown(time_s, place)) detections.push_back(box_at(*pixel, size_px, class_id));
    }
    return process(time_s, std::move(detections));
  }

  /// The same of points (east, north, up), where each pixel is moved by what `noise_px` draws.
  template <typename Noise>
  bool see_points(double time_s, const std::vector<Eigen::Vector3d>& places, Noise noise_px) {
    std::vector<Detection> detections;
    for (const Eigen::Vector3d& place : places) {
      const auto pixel = shown_point(time_s, place);
      if (!pixel) continue;
      const double u = pixel->x() + noise_px(), v = pixel->y() + noise_px();
      detections.push_back(box_at({u, v}));
    }
    return process(time_s, std::move(detections));
  }

  const std::vector<Track>& tracks() const { return geolocator_.tracks(); }
  Geolocator& geolocator() { return geolocator_; }
  const Geolocator& geolocator() const { return geolocator_; }

 private:
  Geolocator geolocator_;
  Path reported_, truth_;
  std::optional<double> accuracy_m_;
  int samples_ = 0;
};

inline double log_odds(const Track& track) {
  return std::log(*track.existence / (1.0 - *track.existence));
}

}  // namespace geoloc::testing
