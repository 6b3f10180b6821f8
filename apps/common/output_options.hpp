// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "common/mqtt_options.hpp"
#include "common/output_files.hpp"
#include "common/outputs.hpp"
#include "geoloc/io/klv/held_video.hpp"
#include "geoloc/io/mqtt/summary_publisher.hpp"
#include "geoloc/io/output/result_file.hpp"

namespace geoloc::apps {

/// The outputs that a command line names; empty ones are left out.
struct OutputOptions {
  std::string objects;             ///< GeoJSON
  std::string raw;                 ///< CSV of every located detection
  std::string picture;             ///< SVG
  std::string rosbag;              ///< MCAP
  std::string klv;                 ///< MPEG transport stream: file, or udp://HOST:PORT
  std::string http;                ///< [HOST:]PORT of the live page
  std::string http_token;          ///< file of the token that the live page asks for; empty: it asks for none
  std::string map;                 ///< file of the page's background map
  std::string summary;             ///< of the flight, for geoloc_fuse
  std::string flight_id;           ///< its name in the summary; empty: time and place of its start
  std::string part_of;             ///< name of the whole flight in the summary; empty: that of the boot
  std::string csv;                 ///< of the objects
  std::string kml;                 ///< of the run
  std::vector<std::string> jsonl;  ///< files, or "-" for standard output
  std::vector<std::string> cot;    ///< endpoints: {udp,tcp,tls}://HOST:PORT
  MqttOptions mqtt;                ///< of the fleet that the flight belongs to

  /// Whether the objects go to standard output as a table: no file holds them, and the output is free.
  bool wants_table() const;

  /// Whether an output is the flight's summary.
  bool wants_summary() const { return !summary.empty() || !mqtt.url.empty(); }

  /// Whether a file shows the raw fixes.
  bool wants_raw_fixes() const { return !raw.empty() || !picture.empty() || !rosbag.empty(); }
};

/// Outputs of objects, whether of a run or of a fleet: --out, --csv, --kml, --cot, --picture, --http,
/// --http-token, --map.
void add_object_outputs(CLI::App& program, OutputOptions& options);

/// These, and the outputs of a run: --jsonl, --raw, --rosbag, --klv, --summary, --flight-id, --part-of,
/// --mqtt and what belongs to it.
void add_output_options(CLI::App& program, OutputOptions& options);

/// Those of them that are files, for check_outputs().
NamedFiles files_of(const OutputOptions& options);

/// The files that they read, as inputs for check_outputs().
NamedFiles inputs_of(const OutputOptions& options);

/// The flight's summary, where an output asks for it.
void add_summary(const OutputOptions& options, const Session& session, io::RunRecord& run);

/// A sink for each, but for the live page (open_live_page()). `old_files`: of the names that are in use.
/// `video` is what --klv passes on; nullptr: the run has none. Throws std::invalid_argument for a target that
/// is none.
void add_sinks(const OutputOptions& options, const EstimationConfig& config, io::OldFile old_files,
               Outputs& outputs, std::shared_ptr<io::HeldVideo> video = nullptr);

/// The sink of --mqtt; nullptr where there is none. Throws std::exception saying what is wrong with it.
std::shared_ptr<const io::SummaryDelivery> add_summary_publisher(const OutputOptions& options,
                                                                 const EstimationConfig& config,
                                                                 Outputs& outputs);

}  // namespace geoloc::apps
