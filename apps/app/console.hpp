// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "app/detection_worker.hpp"
#include "app/live_run.hpp"
#include "common/session.hpp"
#include "geoloc/io/video/video_source.hpp"

namespace geoloc::apps {

/// What a person sees of a live run on stderr: a status line a second, and a message when the link or the
/// video changes its state, repeated at intervals while it is bad.
class Console {
 public:
  explicit Console(HostTime started_at);

  /// To be called often; prints when something is due.
  void update(HostTime now, const Session& session, const io::VideoSource& video,
              const DetectionWorker& worker, const LiveRun& run);

  /// Prints a message on a line of its own.
  void say(const std::string& message);

 private:
  /// A condition that is told when it changes, and again now and then while it lasts.
  struct Topic {
    std::string last;
    HostTime told_at{};
  };

  void tell(Topic& topic, HostTime now, const std::string& message, bool is_bad);

  HostTime started_at_;
  HostTime line_at_{};
  bool is_terminal_;
  bool line_is_open_ = false;
  Topic video_;
  Topic link_;
  Topic size_;
};

}  // namespace geoloc::apps
