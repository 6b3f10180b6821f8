// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Tags are texts; these are the numbers in them.
namespace geoloc::io {

/// `+39.90`, `1234/100`, or a number in brackets; nullopt for anything else, and what is not finite.
std::optional<double> number_in(std::string_view text);

/// The same of a tag that may be missing.
std::optional<double> number_of(const std::optional<std::string>& tag);

/// `(46) (50) (34.31)`; empty where one of them is no number.
std::vector<double> numbers_in(std::string_view text, char separator = ' ');

}  // namespace geoloc::io
