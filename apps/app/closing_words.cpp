// SPDX-License-Identifier: Apache-2.0
#include "app/closing_words.hpp"

#include <algorithm>

#include "common/count_list.hpp"
#include "common/detector_options.hpp"

namespace geoloc::apps {

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
  lines.erase(std::remove(lines.begin(), lines.end(), std::string()), lines.end());
  return lines;
}

}  // namespace geoloc::apps
