// SPDX-License-Identifier: Apache-2.0
#include "part_bytes.hpp"

#include <cstddef>
#include <cstdint>

namespace geoloc::io {
namespace {

template <typename Time>
void put_time(Time time, ByteWriter& writer) {
  writer.put(std::int64_t{time.time_since_epoch().count()});
}

template <typename Time>
void take_time(Time& time, ByteReader& reader) {
  time = Time{Duration{reader.take<std::int64_t>()}};
}

/// Of an unknown: which, mean, the prior's mean and sigma, and the errors.
std::size_t unknown_bytes(std::size_t shared) {
  return 1 + 3 * 8 + shared * 8;
}

}  // namespace

void put_part(const FlightSummary::Part& part, ByteWriter& writer) {
  const FlightState& state = part.state;
  writer.put_text(part.run.whole);
  put_time(part.run.booted_at, writer);
  put_time(part.run.ended_at, writer);
  put_time(state.first_node_at, writer);
  put_time(state.last_node_at, writer);
  for (const double number :
       {state.drift.position_time_constant_s, state.drift.ripple_share, state.drift.ripple_time_constant_s,
        state.drift.up_time_constant_s, state.drift.yaw_time_constant_s})
    writer.put(number);
  writer.put(static_cast<std::uint32_t>(state.unknowns.size()));
  writer.put(static_cast<std::uint32_t>(state.shared_error.cols()));
  for (std::size_t i = 0; i < state.unknowns.size(); ++i) {
    const FlightState::Unknown& unknown = state.unknowns[i];
    writer.put(static_cast<std::uint8_t>(unknown.which));
    writer.put(unknown.mean);
    writer.put(unknown.prior_mean);
    writer.put(unknown.prior_sigma);
    for (Eigen::Index column = 0; column < state.shared_error.cols(); ++column)
      writer.put(state.shared_error(static_cast<Eigen::Index>(i), column));
  }
}

FlightSummary::Part take_part(const std::string& name, ByteReader& reader) {
  FlightSummary::Part part;
  FlightState& state = part.state;
  part.run.whole = reader.take_text();
  take_time(part.run.booted_at, reader);
  take_time(part.run.ended_at, reader);
  take_time(state.first_node_at, reader);
  take_time(state.last_node_at, reader);
  for (double* const number :
       {&state.drift.position_time_constant_s, &state.drift.ripple_share, &state.drift.ripple_time_constant_s,
        &state.drift.up_time_constant_s, &state.drift.yaw_time_constant_s})
    *number = reader.take<double>();
  const auto unknowns = reader.take<std::uint32_t>(), shared = reader.take<std::uint32_t>();
  refuse_absurd_part(name, unknowns, shared);
  if (reader.left() != unknowns * unknown_bytes(shared))
    refuse_summary(name, "is not as long as its counts say: it was cut off or damaged");
  state.shared_error.resize(unknowns, shared);
  for (Eigen::Index i = 0; i < state.shared_error.rows(); ++i) {
    FlightState::Unknown unknown;
    unknown.which = static_cast<FlightUnknown>(reader.take<std::uint8_t>());
    unknown.mean = reader.take<double>();
    unknown.prior_mean = reader.take<double>();
    unknown.prior_sigma = reader.take<double>();
    state.unknowns.push_back(unknown);
    for (Eigen::Index column = 0; column < state.shared_error.cols(); ++column)
      state.shared_error(i, column) = reader.take<double>();
  }
  return part;
}

}  // namespace geoloc::io
