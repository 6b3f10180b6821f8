// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mqtt/summary_inbox.hpp"

#include <exception>
#include <stdexcept>

#include "geoloc/io/fleet/summary_file.hpp"
#include "geoloc/io/mqtt/mqtt_address.hpp"

namespace geoloc::io {
namespace {

constexpr std::size_t kMostShownTopic = 160;

/// Of whatever bytes came, what a terminal can be given.
std::string shown(std::string_view topic) {
  std::string text;
  for (const char c : topic.substr(0, kMostShownTopic))
    text += static_cast<unsigned char>(c) >= 0x20 && static_cast<unsigned char>(c) < 0x7F ? c : '?';
  return text;
}

}  // namespace

FlightSummary SummaryInbox::checked(std::string_view topic, std::string_view payload) const {
  const std::string name = shown(topic);
  const auto flight = flight_of_topic(topic, fleet_);
  if (!flight) throw std::runtime_error(name + ": is no topic of this fleet's summaries");
  if (payload.size() > limits_.most_bytes)
    throw std::runtime_error(name + ": has " + std::to_string(payload.size()) + " bytes; at most " +
                             std::to_string(limits_.most_bytes) + " are taken");
  const auto known = known_.find(*flight);
  if (known == known_.end() && known_.size() >= limits_.most_flights)
    throw std::runtime_error(name + ": the fleet has " + std::to_string(known_.size()) + " flights already");
  const std::size_t before = known == known_.end() ? 0 : known->second.bytes;
  if (bytes_ - before + payload.size() > limits_.most_bytes_of_all)
    throw std::runtime_error(name + ": the fleet's summaries would be larger than " +
                             std::to_string(limits_.most_bytes_of_all) + " bytes together");
  FlightSummary summary = summary_from_bytes(payload, name);
  if (summary.identity.flight != *flight)
    throw std::runtime_error(name + ": is of another flight, " + summary.identity.flight);
  return summary;
}

std::optional<FlightSummary> SummaryInbox::open(std::string_view topic, std::string_view payload) {
  if (payload.empty()) return std::nullopt;
  FlightSummary summary;
  try {
    summary = checked(topic, payload);
  } catch (const std::exception& error) {  // no memory for it, too
    ++counts_.refused;
    last_refusal_ = error.what();
    return std::nullopt;
  }
  const auto known = known_.find(summary.identity.flight);
  if (known != known_.end() && known->second.sequence >= summary.identity.sequence) {
    ++counts_.repeated;
    return std::nullopt;
  }
  know(summary, payload.size());
  ++counts_.taken;
  return summary;
}

void SummaryInbox::know(const FlightSummary& summary, std::size_t bytes) {
  Known& known = known_[summary.identity.flight];
  bytes_ += bytes - known.bytes;
  known = {summary.identity.sequence, bytes};
}

}  // namespace geoloc::io
