// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "tracking/track_table.hpp"

namespace geoloc::testing {

/// What is expected of the camera's height, and of the objects'.
constexpr HeightPrior kHeightPrior{0.0, 2.0};
constexpr double kSigmaGround_m = 3.0;
/// Density of one object in an image of 100 m^2 of ground [1/m^2].
constexpr double kOnePerImage = 0.01;

/// An object stands so high, more or less.
inline PointInformation ground_at(double up_m, double sigma_m = kSigmaGround_m) {
  PointInformation ground;
  ground.matrix(2, 2) = std::pow(sigma_m, -2);
  ground.vector.z() = up_m * ground.matrix(2, 2);
  return ground;
}

/// A look that shares no error with anything: at its place, with the detector's variance per axis.
inline Look lone_look(const Eigen::Vector2d& place, double variance_m2,
                      const Eigen::Vector2d& slope = Eigen::Vector2d::Zero()) {
  Look look;
  look.position = place;
  look.pixel_noise = variance_m2 * Eigen::Matrix2d::Identity();
  look.frame_noise.setZero();
  look.jacobian.setZero();
  look.observation.value = place;
  look.observation.slope = slope;
  look.observation.calibration_jacobian.setZero();
  look.observation.node_jacobian.setZero();
  look.observation.span = {0, 0.25};
  look.observation.information = Eigen::Matrix2d::Identity() / variance_m2;
  look.one_per_image = kOnePerImage;
  look.clutter_density = 1e-4;
  look.size_m = 0.5;
  return look;
}

/// An object that so many such looks have shown, all along one ray. On the ground it stands at `place`.
inline RestingObject& append_seen(TrackTable& tracks, const SharedErrorEstimate& errors,
                                  const Eigen::Vector2d& place, int hits, double variance_m2,
                                  const Eigen::Vector2d& slope = Eigen::Vector2d::Zero()) {
  RestingObject& object = tracks.append();
  object.track.id = tracks.size();
  object.prior = ground_at(0.0);
  begin_sums(object, lone_look(place, variance_m2, slope), errors);
  for (int i = 1; i < hits; ++i) add_to_sums(object, lone_look(place, variance_m2, slope), errors);
  object.track.hits = hits;
  return object;
}

}  // namespace geoloc::testing
