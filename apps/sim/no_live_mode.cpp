// SPDX-License-Identifier: Apache-2.0
// Stands in for live_mode.cpp where GStreamer's RTSP server was not found at configure time.
#include <cstdio>

#include "sim/live_mode.hpp"

namespace geoloc::sim {

int run_live_mode(const RunOptions& /*options*/, const LiveOptions& /*live*/, std::uint64_t /*seed*/) {
  std::fputs(
      "geoloc_sim: built without GStreamer's RTSP server, so it cannot play live: "
      "apt-get install libgstrtspserver-1.0-dev, configure and build again. "
      "--record and --images work without it.\n",
      stderr);
  return 2;
}

}  // namespace geoloc::sim
