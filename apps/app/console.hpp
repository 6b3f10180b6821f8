// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/periodic.hpp"
#include "common/text_writer.hpp"
#include "geoloc/io/output/live_status.hpp"

namespace geoloc::apps {

/// What a person sees of a live run on stderr: a status line, which is written anew in its place on a
/// terminal and every few seconds elsewhere, and a message when the link or the video changes its state,
/// repeated at intervals while it is bad. No call waits for a terminal that is stopped.
class Console {
 public:
  Console();

  void update(const io::LiveStatus& status);

  /// Prints a message on a line of its own.
  void say(const std::string& message);

 private:
  /// A condition that is told when it changes, and again now and then while it lasts.
  struct Topic {
    std::string last;
    HostTime told_at{};
  };

  void tell(Topic& topic, HostTime now, const std::string& message, bool is_bad);

  TextWriter stderr_;
  bool is_terminal_;
  bool line_is_open_ = false;
  Periodic log_line_;
  Topic video_;
  Topic link_;
  Topic clock_;
  Topic warning_;
};

}  // namespace geoloc::apps
