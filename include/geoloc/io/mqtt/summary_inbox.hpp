// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "geoloc/fleet/flight_summary.hpp"

namespace geoloc::io {

/// What a fleet takes from a broker, where anybody may have sent anything.
struct SummaryLimits {
  std::size_t most_bytes = std::size_t{16} << 20;        ///< of a summary: some 20,000 objects
  std::size_t most_bytes_of_all = std::size_t{1} << 30;  ///< of the latest summaries of all flights
  std::size_t most_flights = 4096;
};

/// Opens messages: what is no summary, too large, or of another flight than its topic says is refused and
/// counted.
class SummaryInbox {
 public:
  struct Counts {
    std::uint64_t taken = 0;
    std::uint64_t repeated = 0;  ///< of a sequence number that was there already, or of an earlier one
    std::uint64_t refused = 0;
  };

  explicit SummaryInbox(std::string fleet, const SummaryLimits& limits = {})
      : fleet_(std::move(fleet)), limits_(limits) {}

  /// The flight's newer summary; nullopt where the message holds none. An empty message is none: it is how a
  /// broker is told to forget.
  std::optional<FlightSummary> open(std::string_view topic, std::string_view payload);

  /// One that is known from elsewhere: a message must be newer.
  void know(const FlightSummary& summary, std::size_t bytes);

  const Counts& counts() const { return counts_; }
  /// Why the last one was refused; empty where none was.
  const std::string& last_refusal() const { return last_refusal_; }

 private:
  struct Known {
    std::uint64_t sequence = 0;
    std::size_t bytes = 0;
  };

  FlightSummary checked(std::string_view topic, std::string_view payload) const;

  std::string fleet_;
  SummaryLimits limits_;
  std::map<std::string, Known> known_;  // by flight
  std::size_t bytes_ = 0;               // of all
  Counts counts_;
  std::string last_refusal_;
};

}  // namespace geoloc::io
