// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "common/session.hpp"
#include "geoloc/io/recording/recording.hpp"
#include "geoloc/io/recording/tlog.hpp"

namespace geoloc::apps {

/// Feeds recorded telemetry and frames to a session in the order of the live run. Where the recording does
/// not tell that order, each frame waits for the telemetry it needs, as a live run would. `on_frame` is
/// called after each, with what the session answered; once it returns false, no more are processed.
void replay(const io::Tlog& telemetry, const std::vector<io::RecordedFrame>& frames, Session& session,
            const std::function<bool(const PendingFrame& frame, bool is_located)>& on_frame = {});

}  // namespace geoloc::apps
