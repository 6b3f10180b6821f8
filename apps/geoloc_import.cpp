// SPDX-License-Identifier: Apache-2.0
// Makes recordings of flights that were flown without geoloc, for geoloc_replay.
#include <CLI/CLI.hpp>

#include "common/command_line.hpp"
#include "import/import_options.hpp"
#include "import/stills_command.hpp"
#include "import/video_command.hpp"

int main(int argc, char** argv) {
  CLI::App cli("Makes recordings of flights that were flown without geoloc, for geoloc_replay.",
               "geoloc_import");
  geoloc::apps::StillsOptions stills;
  geoloc::apps::VideoOptions video;
  geoloc::apps::add_stills_command(cli, stills);
  const CLI::App* const video_command = geoloc::apps::add_video_command(cli, video);
  cli.require_subcommand(1);
  if (const auto status = geoloc::apps::parse(cli, argc, argv)) return *status;
  return video_command->parsed() ? geoloc::apps::import_video(video) : geoloc::apps::import_stills(stills);
}
