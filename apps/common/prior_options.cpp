// SPDX-License-Identifier: Apache-2.0
#include "common/prior_options.hpp"

#include <stdexcept>

#include "geoloc/io/config/calibration_file.hpp"
#include "geoloc/io/config/known_points_file.hpp"

namespace geoloc::apps {

void add_prior_options(CLI::App& program, PriorFiles& files) {
  program
      .add_option("--reference", files.references,
                  "Surveyed objects, GeoJSON: they take the receiver's offset out of all others")
      ->type_name("FILE");
  program
      .add_option("--calibration", files.calibration,
                  "The --out of an earlier flight of this camera: what it learnt is where this one begins")
      ->type_name("FILE");
}

void apply_priors(const PriorFiles& files, GeolocatorConfig& config) {
  if (!files.references.empty()) {
    if (config.method != Method::kJoint)
      throw std::runtime_error(
          "--reference: the paper's method has no use for known points; leave out one of the two");
    config.known_points = io::read_known_points(files.references);
  }
  if (!files.calibration.empty())
    config.joint.prior =
        io::read_calibration(files.calibration, config.joint.prior, config.joint.drift.sigma_yaw_deg);
}

}  // namespace geoloc::apps
