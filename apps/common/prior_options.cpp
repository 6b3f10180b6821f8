// SPDX-License-Identifier: Apache-2.0
#include "common/prior_options.hpp"

#include <stdexcept>

#include "geoloc/io/config/calibration_file.hpp"
#include "geoloc/io/config/known_points_file.hpp"

namespace geoloc::apps {

void add_prior_options(CLI::App& program, PriorFiles& files) {
  program
      .add_option("--known-points", files.known_points,
                  "Surveyed objects, GeoJSON: they take the receiver's offset out of all others")
      ->type_name("FILE");
  program.add_option("--reference", files.known_points)->group("");  // its former name
  program
      .add_option("--calibration", files.calibration,
                  "The --out of an earlier flight of this camera: what it learnt is where this one begins")
      ->type_name("FILE");
}

NamedFiles files_of(const PriorFiles& files) {
  NamedFiles inputs;
  add_named(inputs, "--known-points", files.known_points);
  add_named(inputs, "--calibration", files.calibration);
  return inputs;
}

void apply_priors(const PriorFiles& files, GeolocatorConfig& config) {
  if (!files.known_points.empty()) {
    if (config.method != Method::kJoint)
      throw std::runtime_error(
          "--known-points: the paper's method has no use for known points; leave out one of the two");
    config.known_points = io::read_known_points(files.known_points);
  }
  if (files.calibration.empty()) return;
  if (config.method != Method::kJoint)
    throw std::runtime_error(
        "--calibration: the paper's method takes the camera as it is given; leave out one of the two");
  config.joint.prior =
      io::read_calibration(files.calibration, config.joint.prior, config.joint.drift.sigma_yaw_deg);
}

}  // namespace geoloc::apps
