// SPDX-License-Identifier: Apache-2.0
#include "part_json.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "summary_checks.hpp"

namespace geoloc::io {
namespace {

/// By FlightUnknown.
constexpr std::array<std::string_view, kFlightUnknowns> kNames{
    "boresight_x_rad", "boresight_y_rad", "boresight_z_rad", "latency_s",      "height_m",
    "log_focal_ratio", "position_lag_s",  "offset_east_m",   "offset_north_m", "first_east_m",
    "first_north_m",   "first_up_m",      "first_yaw_rad",   "last_east_m",    "last_north_m",
    "last_up_m",       "last_yaw_rad"};

/// The members of a drift's correlation.
const std::array<std::pair<const char*, double DriftCorrelation::*>, 5> kDriftMembers{{
    {"position_time_constant_s", &DriftCorrelation::position_time_constant_s},
    {"ripple_share", &DriftCorrelation::ripple_share},
    {"ripple_time_constant_s", &DriftCorrelation::ripple_time_constant_s},
    {"up_time_constant_s", &DriftCorrelation::up_time_constant_s},
    {"yaw_time_constant_s", &DriftCorrelation::yaw_time_constant_s},
}};

FlightUnknown unknown_by_name(const std::string& name) {
  const auto* const found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) throw std::runtime_error("there is no unknown by the name of " + name);
  return static_cast<FlightUnknown>(found - kNames.begin());
}

void read_unknowns(const std::string& name, const json& unknowns, FlightState& state) {
  if (!unknowns.is_array()) throw std::runtime_error("unknowns must be a list");
  const std::size_t shared = unknowns.empty() ? 0 : member(unknowns.front(), "shared_error").size();
  refuse_absurd_part(name, unknowns.size(), shared);
  state.shared_error.resize(static_cast<Eigen::Index>(unknowns.size()), static_cast<Eigen::Index>(shared));
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const json& value = unknowns[i];
    state.unknowns.push_back({unknown_by_name(text(member(value, "name"), "name")),
                              number(member(value, "mean"), "mean"),
                              number(member(value, "prior_mean"), "prior_mean"),
                              number(member(value, "prior_sigma"), "prior_sigma")});
    const json& errors = list(member(value, "shared_error"), shared, "shared_error");
    for (std::size_t column = 0; column < shared; ++column)
      state.shared_error(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(column)) =
          number(errors[column], "shared_error");
  }
}

}  // namespace

ordered_json part_to_json(const FlightSummary::Part& part) {
  const FlightState& state = part.state;
  auto unknowns = ordered_json::array();
  for (std::size_t i = 0; i < state.unknowns.size(); ++i) {
    const FlightState::Unknown& unknown = state.unknowns[i];
    unknowns.push_back({{"name", kNames[static_cast<std::size_t>(unknown.which)]},
                        {"mean", unknown.mean},
                        {"prior_mean", unknown.prior_mean},
                        {"prior_sigma", unknown.prior_sigma},
                        {"shared_error", row_to_json(state.shared_error.row(static_cast<Eigen::Index>(i)))}});
  }
  ordered_json drift;
  for (const auto& [key, value] : kDriftMembers) drift[key] = state.drift.*value;
  return {{"whole", part.run.whole},
          {"booted_at_ns", part.run.booted_at.time_since_epoch().count()},
          {"ended_at_ns", part.run.ended_at.time_since_epoch().count()},
          {"first_node_at_ns", state.first_node_at.time_since_epoch().count()},
          {"last_node_at_ns", state.last_node_at.time_since_epoch().count()},
          {"drift", std::move(drift)},
          {"unknowns", std::move(unknowns)}};
}

FlightSummary::Part part_from_json(const std::string& name, const json& document) {
  FlightSummary::Part part;
  part.run = {text(member(document, "whole"), "whole"), time<HostTime>(document, "booted_at_ns"),
              time<VehicleTime>(document, "ended_at_ns")};
  part.state.first_node_at = time<VehicleTime>(document, "first_node_at_ns");
  part.state.last_node_at = time<VehicleTime>(document, "last_node_at_ns");
  const json& drift = member(document, "drift");
  for (const auto& [key, value] : kDriftMembers) part.state.drift.*value = number(member(drift, key), key);
  read_unknowns(name, member(document, "unknowns"), part.state);
  return part;
}

}  // namespace geoloc::io
