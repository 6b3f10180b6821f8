// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "geoloc/geometry/time.hpp"

// Numbers and times within texts of others.
namespace geoloc::io {

/// Takes a finite number off the beginning of `text`, spaces before it included; nullopt leaves it as it is.
std::optional<double> take_number(std::string_view& text);

/// The text without spaces, tabs and carriage returns at its ends.
std::string_view trimmed(std::string_view text);

/// The next line, taken off `text`; without its end.
std::string_view take_line(std::string_view& text);

/// A date and a time of day: `2026-05-27 13:10:00.015`, `2017.08.05 14:11:51`, `2026-05-27T13:10:00Z`,
/// `…,123,456`; since 1970, in whatever zone the text means. `rest` is what follows.
std::optional<Duration> date_time_in(std::string_view text, std::string_view* rest = nullptr);

}  // namespace geoloc::io
