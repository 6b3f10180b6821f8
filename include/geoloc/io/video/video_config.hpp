// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace geoloc::io {

enum class RtspTransport {
  kTcp,  ///< nothing is lost; a bad link shows as delay
  kUdp   ///< lost packets damage pictures up to the next whole one
};

const char* to_string(RtspTransport transport);

/// "video" in the configuration file.
struct VideoConfig {
  RtspTransport transport = RtspTransport::kTcp;
  double latency_s = 0.0;  ///< exposure to arrival
  double reorder_s = 0.0;  ///< how long UDP packets out of order are waited for
  double frame_timeout_s = 1.5;
  double connect_timeout_s = 5.0;
  double retry_min_s = 0.25;  ///< between attempts; doubles while they fail
  double retry_max_s = 0.5;
  double max_megapixels = 36.0;

  /// Every fault, named by its path.
  std::vector<std::string> problems() const;
};

}  // namespace geoloc::io
