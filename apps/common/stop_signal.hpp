// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <csignal>

namespace geoloc::apps {

/// Notes SIGINT and SIGTERM. The second one of a kind ends the program at once.
class StopSignal {
 public:
  StopSignal() {
    std::signal(SIGINT, &note);
    std::signal(SIGTERM, &note);
    std::signal(SIGPIPE, SIG_IGN);  // a closed stdout is a write error, not an end
  }
  bool is_requested() const { return requested_ != 0; }

 private:
  static void note(int signal) {
    requested_ = 1;
    std::signal(signal, SIG_DFL);
  }
  // A signal handler can reach nothing but a static.
  static inline volatile std::sig_atomic_t requested_ = 0;
};

}  // namespace geoloc::apps
