// SPDX-License-Identifier: Apache-2.0
#include "app/video_tally.hpp"

#include <fmt/format.h>

namespace geoloc::apps {

VideoTally tally_of(const io::VideoStatus& video, const DetectionWorker::Stats& detection) {
  return {detection.detected, video.dropped, detection.detect_ms.value()};
}

double searched_share(const VideoTally& tally) {
  const std::uint64_t all = tally.searched + tally.dropped;
  return all > 0 ? static_cast<double>(tally.searched) / static_cast<double>(all) : 1.0;
}

std::string slowness(const VideoTally& tally) {
  constexpr double kTolerable = 0.9;
  constexpr std::uint64_t kStartUp = 5;  // frames that come while a network runs for the first time
  if (tally.dropped <= kStartUp || searched_share(tally) >= kTolerable) return {};
  return fmt::format(
      "searched {} of {} frames, {:.0f} ms each: the stream is too fast for this computer, so objects may be "
      "missed. A lower frame rate, a smaller --model or --backend openvino help",
      tally.searched, tally.searched + tally.dropped, tally.detect_ms);
}

}  // namespace geoloc::apps
