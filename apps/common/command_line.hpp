// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace geoloc::apps {

inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;
inline constexpr int kUnusable = 2;  ///< arguments or input

const char* version();

/// Adds --version and parses; nullopt where the program is to go on, otherwise its exit status (0 after
/// --help and --version). An unknown option is refused with the one that it may be meant for.
std::optional<int> parse(CLI::App& program, int argc, char** argv);

/// For options of an unsigned type: CLI11 itself takes -1 for the greatest of them.
CLI::Validator whole_number();

/// The name that a mistyped one is meant for; empty where none is near.
std::string nearest_name(const std::string& mistyped, const std::vector<std::string>& names);

/// Runs `step`; whatever it throws is told on stderr after the program's name. nullopt where it did not
/// throw.
std::optional<int> guard(const char* program, int status, const std::function<void()>& step);

}  // namespace geoloc::apps
