// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "geoloc/sim/world/labelled_images.hpp"

namespace geoloc::sim {

struct ImagesOptions {
  LabelledImages wanted;
  std::string folder;
};

/// Adds --images, --out, --grounds and --crisp; returns the one that chooses this mode.
CLI::Option* add_images_options(CLI::App& program, ImagesOptions& options);

/// Writes the labelled pictures; the program's exit status.
int run_images_mode(ImagesOptions options, std::uint64_t seed);

}  // namespace geoloc::sim
