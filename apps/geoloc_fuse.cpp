// SPDX-License-Identifier: Apache-2.0
// Many flights, one map: summaries of flights in, objects with the flights' common errors taken out.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/command_line.hpp"
#include "common/objects_table.hpp"
#include "common/output_options.hpp"
#include "common/outputs.hpp"
#include "common/run_score.hpp"
#include "geoloc/evaluation/score.hpp"
#include "geoloc/fleet/fusion.hpp"
#include "geoloc/io/fleet/fused_report.hpp"
#include "geoloc/io/fleet/summary_file.hpp"
#include "geoloc/io/output/file_sink.hpp"
#include "geoloc/io/recording/recording_reader.hpp"

namespace {

using namespace geoloc;
using namespace geoloc::apps;

struct Options {
  std::vector<std::string> summaries;
  std::vector<std::string> class_names;
  std::string truth_file;
  FusionConfig fusion;
  OutputOptions outputs;
};

void add_options(CLI::App& program, Options& options) {
  program
      .add_option("summaries", options.summaries,
                  "Files that geoloc_app or geoloc_replay wrote with --summary; of several of one flight the "
                  "latest counts")
      ->type_name("SUMMARY")
      ->required();
  program.add_option("--truth", options.truth_file, "True targets, GeoJSON: the map is scored against them")
      ->type_name("FILE");
  program
      .add_option("--class-names", options.class_names,
                  "Names of the classes from 0, with commas between [their numbers]")
      ->delimiter(',')
      ->type_name("NAME,...");
  const auto add = [&program](const char* name, double& value, const char* help) {
    program.add_option(name, value, help)->capture_default_str()->group("Fusion");
  };
  add("--quarantine-gate", options.fusion.quarantine_gate,
      "Chi-square, 2 degrees of freedom, of a flight's common shift against all others, from which on it is "
      "left out");
  add("--most-shift-m", options.fusion.most_shift_m,
      "How far flights may be off against each other, whatever they say, m");
  add("--sigma-home-m", options.fusion.sigma_home_m, "1-sigma of what a home's height is said to be, m");
  const auto add_file = [&program](const char* name, std::string& file, const char* help) {
    program.add_option(name, file, help)->type_name("FILE")->group("Outputs");
  };
  add_file("--out", options.outputs.objects, "Objects, and what became of the flights, GeoJSON");
  add_file("--csv", options.outputs.csv, "Objects, CSV");
  add_file("--kml", options.outputs.kml, "Objects and ellipses for Google Earth, KML");
  add_file("--picture", options.outputs.picture, "Map, SVG");
  program
      .add_option("--cot", options.outputs.cot,
                  "Objects to TAK: udp://HOST:PORT, tcp://HOST:PORT or tls://HOST:PORT")
      ->type_name("URL")
      ->allow_extra_args(false)
      ->group("Outputs");
}

NamedFiles inputs_of(const Options& options) {
  NamedFiles files;
  for (const std::string& summary : options.summaries) add_named(files, "SUMMARY", summary);
  add_named(files, "--truth", options.truth_file);
  return files;
}

/// All that cannot be read is named, not the first file alone.
Fleet read_fleet(const std::vector<std::string>& files) {
  Fleet fleet;
  std::string faults;
  for (const std::string& file : files) {
    try {
      take(io::read_summary(file), fleet);
    } catch (const std::runtime_error& error) {
      faults += (faults.empty() ? "" : "\n") + std::string(error.what());
    }
  }
  if (!faults.empty()) throw std::runtime_error(faults);
  return fleet;
}

std::vector<Eigen::Vector2d> targets_in(const LocalFrame& frame, const std::string& truth_file) {
  std::vector<Eigen::Vector2d> targets;
  if (truth_file.empty()) return targets;
  for (const io::TrueTarget& target : io::read_truth(truth_file))
    targets.push_back(frame.to_local(target.position).position_in_enu);
  return targets;
}

std::string score_of(const std::vector<io::ObjectReport>& objects,
                     const std::vector<Eigen::Vector2d>& targets) {
  std::vector<Eigen::Vector2d> places;
  std::vector<Gaussian2> gaussians;
  for (const io::ObjectReport& object : objects) {
    places.push_back(object.position_in_enu);
    gaussians.push_back({object.position_in_enu, object.covariance_in_enu});
  }
  const Score score = score_objects(places, targets);
  return words_of(score) +
         fmt::format(", NEES {:.2f} (2 is right)", mean_nees(gaussians, targets, score.target_of_object));
}

/// The map, ready to be written.
struct Result {
  FusedMap map;
  io::RunRecord run;
};

Result make_result(const Options& options) {
  check_outputs(files_of(options.outputs), inputs_of(options));
  const Fleet fleet = read_fleet(options.summaries);
  Result result{fuse(fleet, options.fusion), {}};
  result.run.title = fmt::format("geoloc: {} flights", fleet.size());
  result.run.objects = io::report_objects(result.map, options.class_names);
  result.run.local_frame = result.map.frame;
  result.run.targets = targets_in(*result.map.frame, options.truth_file);
  result.run.summary = fmt::format("{} objects of {} flights", result.run.objects.size(), fleet.size());
  if (!result.run.targets.empty())
    result.run.summary += "\n" + score_of(result.run.objects, result.run.targets);
  return result;
}

/// False where an output could not be written.
bool write(const Options& options, const Result& result) {
  Outputs outputs(options.class_names, io::SinkRunnerConfig{256, io::WhenFull::kWait});
  OutputOptions others = options.outputs;
  others.objects.clear();
  add_sinks(others, EstimationConfig{}, io::OldFile::kReplace, outputs);
  if (!options.outputs.objects.empty()) {
    outputs.add(std::make_unique<io::FileSink>(
        "--out", io::ResultFile(options.outputs.objects, io::OldFile::kReplace, outputs.teller()),
        [&map = result.map](const io::RunRecord& run) { return io::fused_to_geojson(map, run.objects); }));
  }
  outputs.finish(result.run);
  for (const std::string& message : outputs.take_messages())
    std::fprintf(stderr, "geoloc_fuse: %s\n", message.c_str());
  return !outputs.has_failed();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App cli("Fuses flights into one map: objects that several of them saw, and what each was off by.",
               "geoloc_fuse");
  Options options;
  add_options(cli, options);
  if (const auto status = parse(cli, argc, argv)) return *status;

  Result result;
  if (const auto unusable = guard("geoloc_fuse", kUnusable, [&] { result = make_result(options); }))
    return *unusable;
  bool is_written = false;
  if (const auto failed = guard("geoloc_fuse", kFailed, [&] { is_written = write(options, result); }))
    return *failed;
  if (options.outputs.objects.empty()) std::fputs(objects_to_table(result.run.objects).c_str(), stdout);
  std::fprintf(stderr, "%s%s\n", io::flights_to_table(result.map).c_str(), result.run.summary.c_str());
  return is_written ? kDone : kFailed;
}
