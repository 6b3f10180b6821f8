// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/detection_worker.hpp"
#include "app/live_run.hpp"
#include "app/video_tally.hpp"
#include "geoloc/io/detection/detector.hpp"

namespace geoloc::apps {

/// What became of the video in a run that has ended.
struct VideoEnd {
  VideoTally tally;
  DetectionWorker::Stats detection;
  LiveRun::Stats run;
};

/// Lines on frames that were left out, on a detector that found nothing in any, and on how long objects took.
/// `confidence`: the detector's threshold.
std::vector<std::string> closing_words(const VideoEnd& video, const io::DetectorCounts& detector,
                                       double confidence);

}  // namespace geoloc::apps
