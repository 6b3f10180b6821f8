// SPDX-License-Identifier: Apache-2.0
// The synthetic world: a flight played live or recorded, or labelled pictures of it.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>

#include "common/command_line.hpp"
#include "sim/images_mode.hpp"
#include "sim/live_mode.hpp"
#include "sim/option_groups.hpp"
#include "sim/record_mode.hpp"
#include "sim/run_options.hpp"

int main(int argc, char** argv) {
  CLI::App program("A synthetic world for geoloc: flights, recordings and labelled pictures.", "geoloc_sim");
  geoloc::sim::ImagesOptions images;
  geoloc::sim::RunOptions run;
  geoloc::sim::RecordOptions record;
  std::uint64_t seed = 1;
  program.add_option("--seed", seed, "Seed of all that is random")
      ->check(geoloc::apps::whole_number())
      ->capture_default_str();
  geoloc::sim::add_run_options(program, run);
  CLI::Option* const record_wanted = geoloc::sim::add_record_options(program, record);
  geoloc::sim::LiveOptions live;
  geoloc::sim::add_live_options(program, live);
  CLI::Option* const images_wanted = geoloc::sim::add_images_options(program, images);
  if (const auto status = geoloc::apps::parse(program, argc, argv)) return *status;
  const auto mode = *images_wanted   ? geoloc::sim::Mode::kImages
                    : *record_wanted ? geoloc::sim::Mode::kRecord
                                     : geoloc::sim::Mode::kLive;
  const std::string idle = geoloc::sim::options_without_effect(program, mode);
  if (!idle.empty()) {
    std::fprintf(stderr, "geoloc_sim: %s\n", idle.c_str());
    return geoloc::apps::kUnusable;
  }
  switch (mode) {
    case geoloc::sim::Mode::kImages:
      return geoloc::sim::run_images_mode(images, seed);
    case geoloc::sim::Mode::kRecord:
      return geoloc::sim::run_record_mode(run, record, seed);
    case geoloc::sim::Mode::kLive:
      return geoloc::sim::run_live_mode(run, live, seed);
  }
  return geoloc::apps::kUnusable;
}
