// SPDX-License-Identifier: Apache-2.0
#include "common/command_line.hpp"

#include <cstdio>
#include <stdexcept>

#include "geoloc/io/config/calibration_file.hpp"
#include "geoloc/io/config/known_points_file.hpp"

namespace geoloc::apps {

void add_output_options(CLI::App& program, OutputFiles& files) {
  const auto add = [&program](const char* name, std::string& file, const char* help) {
    program.add_option(name, file, help)->type_name("FILE")->group("Outputs");
  };
  add("--out", files.objects, "Confirmed objects, GeoJSON");
  add("--csv", files.csv, "Confirmed objects, CSV");
  add("--kml", files.kml, "Objects, ellipses and trajectory for Google Earth, KML");
  const auto add_several = [&program](const char* name, std::vector<std::string>& targets, const char* help,
                                      const char* type) {
    program.add_option(name, targets, help)->type_name(type)->allow_extra_args(false)->group("Outputs");
  };
  add_several("--jsonl", files.jsonl, "Frames and objects as they come, JSON Lines; - is stdout", "FILE");
  add_several("--cot", files.cot,
              "Confirmed objects to TAK: udp://HOST:PORT or tcp://HOST:PORT; ATAK: udp://239.2.3.1:6969",
              "URL");
  add("--raw", files.raw, "Every located detection, CSV");
  add("--picture", files.picture, "Map of the run, SVG");
  program
      .add_option("--http", files.http,
                  "A page that shows the run, for browsers: PORT for those of this computer, or HOST:PORT")
      ->type_name("[HOST:]PORT")
      ->group("Outputs");
}

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

void apply_priors(const PriorFiles& files, GeolocatorConfig& config) {
  if (!files.known_points.empty()) {
    if (config.method != Method::kJoint)
      throw std::runtime_error(
          "--known-points: the paper's method has no use for known points; leave out one of the two");
    config.known_points = io::read_known_points(files.known_points);
  }
  if (!files.calibration.empty())
    config.joint.prior =
        io::read_calibration(files.calibration, config.joint.prior, config.joint.drift.sigma_yaw_deg);
}

std::optional<int> parse(CLI::App& program, int argc, char** argv) {
  try {
    program.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? kDone : kUnusable;
  }
}

std::optional<int> guard(const char* program, int status, const std::function<void()>& step) {
  try {
    step();
    return std::nullopt;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", program, error.what());
    return status;
  }
}

}  // namespace geoloc::apps
