// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <csignal>

namespace geoloc::apps {

/// What the system would end or stop a program for becomes an error of the write that it is about: a closed
/// stdout, a file that may not grow, a terminal that takes no words from a background job.
inline void take_write_signals_as_errors() {
  for (const int signal : {SIGPIPE, SIGXFSZ, SIGTTOU}) std::signal(signal, SIG_IGN);
}

/// Notes SIGINT and SIGTERM, of which the second one of a kind ends the program at once, and SIGHUP, which
/// comes more than once when a terminal goes away (a dropped ssh). nohup's wish is kept.
class StopSignal {
 public:
  StopSignal() {
    std::signal(SIGINT, &note);
    std::signal(SIGTERM, &note);
    if (std::signal(SIGHUP, &note_hang_up) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
    take_write_signals_as_errors();
  }
  bool is_requested() const { return requested_ != 0; }

 private:
  static void note(int signal) {
    requested_ = 1;
    std::signal(signal, SIG_DFL);
  }
  static void note_hang_up(int /*signal*/) { requested_ = 1; }
  // A signal handler can reach nothing but a static.
  static inline volatile std::sig_atomic_t requested_ = 0;
};

}  // namespace geoloc::apps
