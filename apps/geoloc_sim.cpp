// SPDX-License-Identifier: Apache-2.0
// The synthetic world: a flight played live or recorded, or labelled pictures of it.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "sim/images_mode.hpp"

int main(int argc, char** argv) {
  CLI::App program("A synthetic world for geoloc: flights, recordings and labelled pictures.", "geoloc_sim");
  geoloc::sim::ImagesOptions images;
  CLI::Option* const images_wanted = geoloc::sim::add_images_options(program, images);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? 0 : 2;
  }
  if (*images_wanted) return geoloc::sim::run_images_mode(images);
  std::fputs("geoloc_sim: nothing to do; see --help\n", stderr);
  return 2;
}
