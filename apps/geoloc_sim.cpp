// SPDX-License-Identifier: Apache-2.0
// The synthetic world: a flight played live or recorded, or labelled pictures of it.
#include <CLI/CLI.hpp>
#include <cstdint>

#include "sim/images_mode.hpp"
#include "sim/live_mode.hpp"
#include "sim/record_mode.hpp"
#include "sim/run_options.hpp"

int main(int argc, char** argv) {
  CLI::App program("A synthetic world for geoloc: flights, recordings and labelled pictures.", "geoloc_sim");
  geoloc::sim::ImagesOptions images;
  geoloc::sim::RunOptions run;
  geoloc::sim::RecordOptions record;
  std::uint64_t seed = 1;
  program.add_option("--seed", seed, "Seed of all that is random")->capture_default_str();
  geoloc::sim::add_run_options(program, run);
  CLI::Option* const record_wanted = geoloc::sim::add_record_options(program, record);
  geoloc::sim::LiveOptions live;
  geoloc::sim::add_live_options(program, live);
  CLI::Option* const images_wanted = geoloc::sim::add_images_options(program, images);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? 0 : 2;
  }
  if (*images_wanted) return geoloc::sim::run_images_mode(images, seed);
  if (*record_wanted) return geoloc::sim::run_record_mode(run, record, seed);
  return geoloc::sim::run_live_mode(run, live, seed);
}
