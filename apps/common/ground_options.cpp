// SPDX-License-Identifier: Apache-2.0
#include "common/ground_options.hpp"

#include <stdexcept>

namespace geoloc::apps {
namespace {

/// 1-sigma of heights of which nothing is known.
constexpr double kFreeSigma_m = 1000.0;

}  // namespace

void add_ground_sigma_option(CLI::App& program, GroundOptions& options) {
  program
      .add_option("--ground-sigma-m", options.sigma_m,
                  "1-sigma of an object's height above or below that ground, m [joint.sigma_ground_m: 3]")
      ->check(CLI::Range(0.0, 1000.0))
      ->type_name("X");
}

void apply_ground_sigma(const GroundOptions& options, GeolocatorConfig& config) {
  if (options.ground == kFreeGround) {
    if (options.sigma_m)
      throw std::runtime_error("--ground-sigma-m: heights that are free have none; leave out one of the two");
    config.joint.sigma_ground_m = kFreeSigma_m;
  }
  if (options.sigma_m) config.joint.sigma_ground_m = *options.sigma_m;
}

}  // namespace geoloc::apps
