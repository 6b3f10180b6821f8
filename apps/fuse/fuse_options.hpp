// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "common/mqtt_options.hpp"
#include "common/output_options.hpp"
#include "geoloc/fleet/fusion.hpp"

namespace geoloc::apps {

/// geoloc_fuse's command line.
struct FuseOptions {
  std::vector<std::string> summaries;
  MqttOptions mqtt;
  double fuse_every_s = 2.0;
  std::string state_folder;
  std::string postgis;
  std::string fleet;  ///< its name in the database; empty: that of --mqtt, or "fleet"
  std::string truth_file;
  std::string known_points_file;
  std::vector<std::string> class_names;
  FusionConfig fusion;
  OutputOptions outputs;
};

void add_fuse_options(CLI::App& program, FuseOptions& options);

/// Every file that is read, for check_outputs().
NamedFiles inputs_of(const FuseOptions& options);

/// Throws std::runtime_error where options have no effect, or nothing says where flights come from.
void check(const FuseOptions& options);

}  // namespace geoloc::apps
