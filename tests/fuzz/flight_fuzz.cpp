// SPDX-License-Identifier: Apache-2.0
// Fuzzes what the simulator reads from a flight's folder: truth as gzip and as text, frames of the log.
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "geoloc/sim/flight/mavlink_frame.hpp"
#include "truth_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace geoloc::sim;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const Trajectory trajectory(parse_truth_csv(text, "fuzz"), Site{});
    const TimeSpan survey = trajectory.survey();
    trajectory.pose(survey.begin);
    trajectory.pose(survey.end);
  } catch (const std::exception&) {
  }
  try {
    parse_truth_csv(gunzip(text, "fuzz", std::size_t{1} << 20U), "fuzz");
  } catch (const std::exception&) {
  }
  if (const auto frame = view_frame(data, size)) {
    volatile std::uint8_t last = frame->payload_size > 0 ? frame->payload[frame->payload_size - 1] : 0;
    static_cast<void>(last);
  }
  return 0;
}
