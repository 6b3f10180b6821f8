// SPDX-License-Identifier: Apache-2.0
#include <stdexcept>

#include "sim/flight_video.hpp"

namespace geoloc::sim {

void write_flight_video(const std::filesystem::path& /*file*/, const Flight& /*flight*/,
                        const RunSettings& /*settings*/, const std::vector<io::RecordedFrame>& /*frames*/,
                        bool /*has_sei*/) {
  throw std::runtime_error("--video needs GStreamer, which this build of geoloc_sim lacks");
}

}  // namespace geoloc::sim
