// SPDX-License-Identifier: Apache-2.0
#include "common/ground_options.hpp"

#include <stdexcept>
#include <utility>

#include "geoloc/io/dem/dem_file.hpp"

namespace geoloc::apps {
namespace {

/// A share of the camera's height: beyond half of it, all first looks could be looks at something just below
/// the camera, and objects are taken for each other.
constexpr double kFreeShare = 0.4;

}  // namespace

bool is_file(const GroundOptions& options) {
  return options.ground != kLevelGround && options.ground != kFreeGround;
}

void add_ground_options(CLI::App& program, GroundOptions& options) {
  program
      .add_option("--ground", options.ground,
                  "plane, free (heights are not expected to be those of a plane), or an elevation model: "
                  "GeoTIFF, .hgt, DTED, ASCII grid")
      ->type_name("plane|free|FILE")
      ->capture_default_str();
  add_ground_sigma_option(program, options);
}

void add_ground_sigma_option(CLI::App& program, GroundOptions& options) {
  program
      .add_option("--ground-sigma-m", options.sigma_m,
                  "1-sigma of an object's height above or below that ground, m [joint.sigma_ground_m: 3]")
      ->check(CLI::Range(0.0, 1000.0))
      ->type_name("X");
}

NamedFiles files_of(const GroundOptions& options) {
  return is_file(options) ? NamedFiles{{"--ground", options.ground}} : NamedFiles{};
}

std::string apply_ground(const GroundOptions& options, GeolocatorConfig& config) {
  apply_ground_sigma(options, config);
  if (!is_file(options)) return {};
  io::Dem dem = io::read_dem(options.ground);
  config.terrain = std::move(dem.heights);
  return "ground: " + dem.remarks;
}

void apply_ground_sigma(const GroundOptions& options, GeolocatorConfig& config) {
  if (config.method != Method::kJoint && (options.ground == kFreeGround || options.sigma_m))
    throw std::runtime_error(std::string(options.sigma_m ? "--ground-sigma-m" : "--ground free") +
                             ": the paper's method takes all objects to lie on the ground; leave out one of "
                             "the two");
  if (options.ground == kFreeGround) {
    if (options.sigma_m)
      throw std::runtime_error("--ground-sigma-m: free heights have no sigma; leave out one of the two");
    config.joint.sigma_ground_share = kFreeShare;
  }
  if (options.sigma_m) config.joint.sigma_ground_m = *options.sigma_m;
}

}  // namespace geoloc::apps
