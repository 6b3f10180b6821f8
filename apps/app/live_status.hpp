// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/detection_worker.hpp"
#include "app/live_run.hpp"
#include "common/session.hpp"
#include "geoloc/io/output/live_status.hpp"
#include "geoloc/io/video/video_source.hpp"

namespace geoloc::apps {

/// How the run is doing now. `damage`: what is to be said of damaged frames, or empty. `doubt`: what seems
/// wrong with the input as a whole, or empty.
io::LiveStatus live_status(HostTime now, HostTime started_at, const Session& session,
                           const TelemetryInput& telemetry, const io::VideoSource& video,
                           const DetectionWorker& worker, const LiveRun& run, const std::string& damage,
                           const std::string& doubt);

}  // namespace geoloc::apps
