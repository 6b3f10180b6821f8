// SPDX-License-Identifier: Apache-2.0
#include "app/closing_words.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/count_list.hpp"
#include "common/detector_options.hpp"

namespace geoloc::apps {
namespace {

/// Empty where no frame was located.
std::string delays_in_words(const FrameDelays& delays) {
  if (delays.total.count() == 0) return {};
  constexpr double kMedian = 0.5, kNearlyAll = 0.99;
  return fmt::format(
      "from capture to objects {:.0f} ms (99 % within {:.0f} ms): {:.0f} ms until the frame was here, "
      "{:.0f} ms for the detector, {:.0f} ms for telemetry and estimate (medians)",
      delays.total.ms(kMedian), delays.total.ms(kNearlyAll), delays.to_arrival.ms(kMedian),
      delays.in_search.ms(kMedian), delays.in_wait.ms(kMedian));
}

}  // namespace

std::vector<std::string> closing_words(const VideoEnd& video, const io::DetectorCounts& detector,
                                       double confidence) {
  std::vector<std::string> lines{
      slowness(video.tally),
      list_of_counts("frames left out",
                     {{video.detection.wrong_size, "of another size than the camera's calibration"},
                      {video.run.untold, "without telemetry"},
                      {video.run.out_of_order, "older than one before, or stamped in the future"},
                      {video.detection.overflowed + video.run.overflowed, "for too many waited"}})};
  if (video.detection.detected > 0 && video.detection.detections == 0)
    lines.push_back(nothing_detected(detector, confidence));
  lines.push_back(delays_in_words(video.run.delays));
  lines.erase(std::remove(lines.begin(), lines.end(), std::string()), lines.end());
  return lines;
}

}  // namespace geoloc::apps
