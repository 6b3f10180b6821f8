// SPDX-License-Identifier: Apache-2.0
#include "fuse/fuse_options.hpp"

#include <stdexcept>

namespace geoloc::apps {
namespace {

void add_inputs(CLI::App& program, FuseOptions& options) {
  program
      .add_option("summaries", options.summaries,
                  "Files that geoloc_app or geoloc_replay wrote with --summary; of several of one flight the "
                  "latest counts")
      ->type_name("SUMMARY");
  program.add_option("--truth", options.truth_file, "True targets, GeoJSON: the map is scored against them")
      ->type_name("FILE");
  program
      .add_option("--known-points", options.known_points_file,
                  "Surveyed objects, GeoJSON: the flights are held against them, too")
      ->type_name("FILE");
  program
      .add_option("--class-names", options.class_names,
                  "Names of the classes from 0, with commas between [their numbers]")
      ->delimiter(',')
      ->type_name("NAME,...");
}

void add_fleet_options(CLI::App& program, FuseOptions& options) {
  add_mqtt_options(program, options.mqtt,
                   "Fuses the flights of a fleet as their summaries come, until Ctrl-C: "
                   "mqtt://[USER@]HOST[:PORT]/FLEET, or mqtts://");
  program.add_option("--every", options.fuse_every_s, "How often it fuses at most, s")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 3600.0))
      ->type_name("X")
      ->needs(program.get_option("--mqtt"))
      ->group("Fleet");
  program
      .add_option("--state", options.state_folder,
                  "Keeps the latest summaries and the objects' ids, and goes on from them when it is started "
                  "again")
      ->type_name("DIR")
      ->group("Fleet");
  CLI::Option* const postgis = program.add_option(
      "--postgis", options.postgis,
      "Map, flights, history and summaries into a PostGIS database: postgresql://USER@HOST/DATABASE");
  postgis->type_name("URL")->group("Fleet");
  program
      .add_option("--fleet", options.fleet, "Name of the fleet in the database [that of --mqtt, or fleet]")
      ->type_name("NAME")
      ->needs(postgis)
      ->group("Fleet");
}

void add_fusion_options(CLI::App& program, FusionConfig& fusion) {
  const auto add = [&program](const char* name, double& value, const char* help) {
    program.add_option(name, value, help)->capture_default_str()->group("Fusion");
  };
  add("--quarantine-gate", fusion.quarantine_gate,
      "Chi-square, 2 degrees of freedom, of a flight's common shift against all others, from which on it is "
      "left out");
  add("--most-shift-m", fusion.most_shift_m,
      "How far flights may be off against each other, whatever they say, m");
  add("--sigma-home-m", fusion.sigma_home_m, "1-sigma of what a home's height is said to be, m");
}

}  // namespace

void add_fuse_options(CLI::App& program, FuseOptions& options) {
  add_inputs(program, options);
  add_fleet_options(program, options);
  add_fusion_options(program, options.fusion);
  add_object_outputs(program, options.outputs);
}

NamedFiles inputs_of(const FuseOptions& options) {
  NamedFiles files = joined({inputs_of(options.mqtt), inputs_of(options.outputs)});
  for (const std::string& summary : options.summaries) add_named(files, "SUMMARY", summary);
  add_named(files, "--truth", options.truth_file);
  add_named(files, "--known-points", options.known_points_file);
  return files;
}

void check(const FuseOptions& options) {
  if (options.summaries.empty() && options.mqtt.url.empty() && options.state_folder.empty() &&
      options.postgis.empty())
    throw std::runtime_error("name SUMMARY files, or a broker with --mqtt; see --help");
  if (!options.fleet.empty() && !is_flight_name(options.fleet))
    throw std::runtime_error("--fleet: a fleet's name is 1 to 64 letters, digits, or any of - _ . :");
}

}  // namespace geoloc::apps
