// SPDX-License-Identifier: Apache-2.0
#include "common/output_options.hpp"

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include "common/session_summary.hpp"
#include "geoloc/io/fleet/summary_file.hpp"
#include "geoloc/io/klv/klv_sink.hpp"
#include "geoloc/io/klv/klv_target.hpp"
#include "geoloc/io/output/cot_sink.hpp"
#include "geoloc/io/output/csv.hpp"
#include "geoloc/io/output/file_sink.hpp"
#include "geoloc/io/output/geojson.hpp"
#include "geoloc/io/output/json_lines_sink.hpp"
#include "geoloc/io/output/kml.hpp"
#include "geoloc/io/output/raw_fixes.hpp"
#include "geoloc/io/output/rosbag.hpp"
#include "geoloc/io/output/run_picture.hpp"

namespace geoloc::apps {
namespace {

std::string raw_csv(const io::RunRecord& run) {
  return io::raw_fixes_to_csv(run.raw_fixes, run.local_frame.value_or(LocalFrame({0.0, 0.0})));
}

bool ends_in_json(const std::string& file) {
  constexpr std::string_view kEnd = ".json";
  return file.size() >= kEnd.size() && file.compare(file.size() - kEnd.size(), kEnd.size(), kEnd) == 0;
}

std::string summary_text(const io::RunRecord& run, bool is_json) {
  if (!run.flight_summary)
    throw std::runtime_error(
        "there is no flight to summarise: no frame was located, since the vehicle's "
        "position was not known");
  return is_json ? io::summary_to_json(*run.flight_summary) : io::summary_to_bytes(*run.flight_summary);
}

/// Throws std::invalid_argument where there will be none, or none that can be read.
void check_summary(const OutputOptions& options, const EstimationConfig& config) {
  if (!options.wants_summary()) {
    if (!options.flight_id.empty())
      throw std::invalid_argument(
          "--flight-id names the flight in its summary: give --summary or --mqtt, too");
    if (!options.part_of.empty())
      throw std::invalid_argument(
          "--part-of names the whole flight in the summary of a part: give --summary or --mqtt, too");
    return;
  }
  if (config.geolocator.method != Method::kJoint)
    throw std::invalid_argument(std::string(options.summary.empty() ? "--mqtt" : "--summary") +
                                ": the method paper does not know what its objects are off by in "
                                "common; use --method joint");
  FlightSummary named;
  named.identity.flight = options.flight_id.empty() ? "a" : options.flight_id;
  for (const std::string& problem : named.problems())
    throw std::invalid_argument("--flight-id " + options.flight_id + ": " + problem);
  if (!options.part_of.empty() && !is_flight_name(options.part_of))
    throw std::invalid_argument("--part-of " + options.part_of +
                                ": a flight's name must be 1 to 64 letters, digits, or any of - _ . :");
}

}  // namespace

void add_summary(const OutputOptions& options, const Session& session, io::RunRecord& run) {
  if (options.wants_summary())
    run.flight_summary = summarize_session(session, options.flight_id, options.part_of);
}

bool OutputOptions::wants_table() const {
  return objects.empty() && std::find(jsonl.begin(), jsonl.end(), "-") == jsonl.end();
}

namespace {

void add_file(CLI::App& program, const char* name, std::string& file, const char* help) {
  program.add_option(name, file, help)->type_name("FILE")->group("Outputs");
}

void add_several(CLI::App& program, const char* name, std::vector<std::string>& targets, const char* help,
                 const char* type) {
  program.add_option(name, targets, help)->type_name(type)->allow_extra_args(false)->group("Outputs");
}

}  // namespace

void add_object_outputs(CLI::App& program, OutputOptions& options) {
  add_file(program, "--out", options.objects, "Confirmed objects, GeoJSON");
  add_file(program, "--csv", options.csv, "Confirmed objects, CSV");
  add_file(program, "--kml", options.kml, "Objects, ellipses and trajectory for Google Earth, KML");
  add_several(program, "--cot", options.cot,
              "Confirmed objects to TAK: udp://HOST:PORT, tcp://HOST:PORT or tls://HOST:PORT; ATAK: "
              "udp://239.2.3.1:6969",
              "URL");
  add_file(program, "--picture", options.picture, "Map of the run, SVG");
  CLI::Option* const http = program.add_option(
      "--http", options.http,
      "A page that shows the run, for browsers: PORT for those of this computer, or HOST:PORT");
  http->type_name("[HOST:]PORT")->group("Outputs");
  program
      .add_option("--http-token", options.http_token,
                  "The page asks for the token in this file, which is made where it is not there")
      ->type_name("FILE")
      ->needs(http)
      ->group("Outputs");
  program
      .add_option("--map", options.map,
                  "Background of the page's map: MBTiles or GeoTIFF [the relief of --ground FILE]")
      ->type_name("FILE")
      ->needs(http)
      ->group("Outputs");
}

void add_output_options(CLI::App& program, OutputOptions& options) {
  add_object_outputs(program, options);
  add_several(program, "--jsonl", options.jsonl, "Frames and objects as they come, JSON Lines; - is stdout",
              "FILE");
  add_file(program, "--raw", options.raw, "Every located detection, CSV");
  add_file(program, "--rosbag", options.rosbag, "Trajectory, raw fixes and objects as a bag of ROS 2, MCAP");
  program
      .add_option("--klv", options.klv,
                  "The video with what its frames show, MISB ST 0601 in an MPEG transport stream: FILE, or "
                  "udp://HOST:PORT; of a recording, without the video")
      ->type_name("FILE|URL")
      ->group("Outputs");
  add_file(program, "--summary", options.summary,
           "All that the flight knows of its objects, for geoloc_fuse; JSON where the name ends in .json");
  program
      .add_option("--flight-id", options.flight_id,
                  "Name of the flight in its summary [time and place of its start, and the vehicle's number]")
      ->type_name("NAME")
      ->group("Outputs");
  program
      .add_option(
          "--part-of", options.part_of,
          "Name of the whole flight, where this is a part of it [parts are known by the vehicle's boot]")
      ->type_name("NAME")
      ->group("Outputs");
  add_mqtt_options(
      program, options.mqtt,
      "The flight's summary to its fleet, every 5 s: mqtt://[USER@]HOST[:PORT]/FLEET, or mqtts://");
}

NamedFiles files_of(const OutputOptions& options) {
  NamedFiles files;
  add_named(files, "--out", options.objects);
  add_named(files, "--raw", options.raw);
  add_named(files, "--csv", options.csv);
  add_named(files, "--kml", options.kml);
  add_named(files, "--picture", options.picture);
  add_named(files, "--rosbag", options.rosbag);
  if (!io::parse_klv_target(options.klv)) add_named(files, "--klv", options.klv);
  add_named(files, "--summary", options.summary);
  for (const std::string& target : options.jsonl) {
    if (target != "-") add_named(files, "--jsonl", target);
  }
  return files;
}

NamedFiles inputs_of(const OutputOptions& options) {
  NamedFiles files = inputs_of(options.mqtt);
  add_named(files, "--http-token", options.http_token);
  add_named(files, "--map", options.map);
  return files;
}

void add_sinks(const OutputOptions& options, const EstimationConfig& config, io::OldFile old_files,
               Outputs& outputs, std::shared_ptr<io::HeldVideo> video) {
  const auto add = [&](const char* option, const std::string& file, io::FileSink::Render render) {
    if (file.empty()) return;
    outputs.add(std::make_unique<io::FileSink>(option, io::ResultFile(file, old_files, outputs.teller()),
                                               std::move(render)));
  };
  add("--out", options.objects,
      [](const io::RunRecord& run) { return io::objects_to_geojson(run.objects, run.estimator); });
  add("--raw", options.raw, raw_csv);
  add("--csv", options.csv, [](const io::RunRecord& run) { return io::objects_to_csv(run.objects); });
  add("--kml", options.kml, io::run_to_kml);
  for (const std::string& target : options.jsonl)
    outputs.add(std::make_unique<io::JsonLinesSink>(target, old_files, outputs.teller()));
  if (!options.cot.empty() && !outputs.has_geoid())
    outputs.teller()(
        "--cot: the geoid EGM96 is not installed: heights are sent as unknown, and above mean sea level in "
        "the "
        "remarks. Build geoloc with Debian's proj-data, or run geographiclib-get-geoids egm96-5");
  for (const std::string& target : options.cot)
    outputs.add(std::make_unique<io::CotSink>(target, config.cot, outputs.teller()));
  add("--picture", options.picture, [](const io::RunRecord& run) { return io::to_svg(io::picture_of(run)); });
  add("--rosbag", options.rosbag, io::run_to_rosbag);
  if (!options.klv.empty())
    outputs.add(std::make_unique<io::KlvSink>(options.klv, old_files, outputs.teller(), std::move(video)));
  check_summary(options, config);
  add("--summary", options.summary, [is_json = ends_in_json(options.summary)](const io::RunRecord& run) {
    return summary_text(run, is_json);
  });
}

std::shared_ptr<const io::SummaryDelivery> add_summary_publisher(const OutputOptions& options,
                                                                 const EstimationConfig& config,
                                                                 Outputs& outputs) {
  if (options.mqtt.url.empty()) return nullptr;
  check_summary(options, config);
  const io::MqttAccess access = mqtt_access(options.mqtt);
  if (const std::string warning = warning_of(access); !warning.empty()) outputs.teller()(warning);
  auto delivery = std::make_shared<io::SummaryDelivery>();
  outputs.add(std::make_unique<io::SummaryPublisher>(access, outputs.teller(), delivery));
  return delivery;
}

}  // namespace geoloc::apps
