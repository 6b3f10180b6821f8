// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "geoloc/fleet/flight_summary.hpp"

// Flight summaries as bytes and as JSON (docs/formats.md). Both hold every bit of the numbers. What comes
// from elsewhere may hold anything: readers throw std::runtime_error that names the source and what is wrong,
// and what they return has no problems().
namespace geoloc::io {

/// The newest; a summary that is no part of a flight is written as version 1.
inline constexpr std::uint32_t kSummaryVersion = 2;

/// The largest summary that is read, from a file or a message.
inline constexpr std::size_t kMostSummaryBytes = std::size_t{256} << 20;

std::string summary_to_bytes(const FlightSummary& summary);

/// `name` stands for the source in messages.
FlightSummary summary_from_bytes(std::string_view bytes, const std::string& name);

/// The checksum that ends the bytes of a summary, of all before it.
std::uint64_t summary_checksum(std::string_view bytes);

/// For people and other programs.
std::string summary_to_json(const FlightSummary& summary);
FlightSummary summary_from_json(std::string_view text, const std::string& name);

/// Either form: JSON begins with a brace.
FlightSummary parse_summary(std::string_view content, const std::string& name);
FlightSummary read_summary(const std::filesystem::path& file);

}  // namespace geoloc::io
