// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>

namespace geoloc::apps {

inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;
inline constexpr int kUnusable = 2;  ///< arguments or input

/// Parses; nullopt where the program is to go on, otherwise its exit status (0 after --help).
std::optional<int> parse(CLI::App& program, int argc, char** argv);

/// Runs `step`; whatever it throws is told on stderr after the program's name. nullopt where it did not
/// throw.
std::optional<int> guard(const char* program, int status, const std::function<void()>& step);

}  // namespace geoloc::apps
