// SPDX-License-Identifier: Apache-2.0
#include "common/command_line.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <numeric>
#include <system_error>
#include <utility>

#include "common/last_words.hpp"

namespace geoloc::apps {
namespace {

/// Letters to put in, take out, or replace (Levenshtein).
std::size_t edits_between(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, replaced}));
    }
  }
  return row.back();
}

std::vector<std::string> names_of_options(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::Option* option : program.get_options()) {
    if (option->get_group().empty()) continue;  // hidden
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  for (const CLI::App* command : program.get_subcommands()) {  // those of the command line
    for (std::string& name : names_of_options(*command)) names.push_back(std::move(name));
  }
  return names;
}

/// What is left over of a command line, each with what it may be meant for.
std::string unknown_arguments(const CLI::App& program) {
  std::string lines;
  for (const std::string& argument : program.remaining(true)) {
    const bool is_option = argument.rfind('-', 0) == 0;
    const std::string name = argument.substr(0, argument.find('='));
    const std::string meant = is_option ? nearest_name(name, names_of_options(program)) : "";
    lines += program.get_name() + (is_option ? ": there is no option " + name : ": unexpected: " + argument) +
             (meant.empty() ? "" : "; did you mean " + meant + "?") + "\n";
  }
  return lines + "Run with --help for more information.\n";
}

}  // namespace

const char* version() {
  return GEOLOC_VERSION;
}

std::optional<int> parse(CLI::App& program, int argc, char** argv) {
  program.set_version_flag("--version", program.get_name() + " " + version(), "Print the version, and exit");
  try {
    program.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::ExtrasError&) {
    std::fputs(unknown_arguments(program).c_str(), stderr);
    return kUnusable;
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? kDone : kUnusable;
  }
}

CLI::Validator whole_number() {
  return CLI::Validator(
      [](const std::string& text) -> std::string {
        std::uint64_t value = 0;
        const char* const end = text.data() + text.size();
        const auto parsed = std::from_chars(text.data(), end, value);
        if (parsed.ec == std::errc{} && parsed.ptr == end) return {};
        return text + " is no whole number from 0 to 18446744073709551615";
      },
      "");
}

std::string nearest_name(const std::string& mistyped, const std::vector<std::string>& names) {
  constexpr std::size_t kMostEdits = 2;
  std::string nearest;
  std::size_t least = kMostEdits + 1;
  for (const std::string& name : names) {
    // What was begun and not ended is as good as one letter wrong.
    const bool is_begun = mistyped.size() > 3 && name.rfind(mistyped, 0) == 0;
    const std::size_t edits = is_begun ? 1 : edits_between(mistyped, name);
    if (edits >= least) continue;
    least = edits;
    nearest = name;
  }
  return nearest;
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
