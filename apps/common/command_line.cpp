// SPDX-License-Identifier: Apache-2.0
#include "common/command_line.hpp"

#include <cstdio>

namespace geoloc::apps {

void add_output_options(CLI::App& program, OutputFiles& files) {
  const auto add = [&program](const char* name, std::string& file, const char* help) {
    program.add_option(name, file, help)->type_name("FILE")->group("Outputs");
  };
  add("--out", files.objects, "Confirmed objects, GeoJSON");
  add("--raw", files.raw, "Every located detection, CSV");
  add("--picture", files.picture, "Map of the run, SVG");
}

std::optional<int> parse(CLI::App& program, int argc, char** argv) {
  try {
    program.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? kDone : kUnusable;
  }
}

std::optional<int> guard(const char* program, int status, const std::function<void()>& step) {
  try {
    step();
    return std::nullopt;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", program, error.what());
    return status;
  }
}

}  // namespace geoloc::apps
