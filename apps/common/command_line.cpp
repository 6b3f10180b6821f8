// SPDX-License-Identifier: Apache-2.0
#include "common/command_line.hpp"

#include <cstdio>
#include <exception>

#include "common/last_words.hpp"

namespace geoloc::apps {

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
    std::fprintf(stderr, "%s: %s\n", program, reason_of(error));
    return status;
  }
}

}  // namespace geoloc::apps
