// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <cstdio>

namespace geoloc::apps {

/// A line on a terminal that tells how far a long step is; silent for short steps and where stderr is no
/// terminal.
class ProgressLine {
 public:
  ProgressLine(const char* what, std::size_t total)
      : what_(what), total_(total), is_terminal_(::isatty(STDERR_FILENO) == 1) {}

  void show(std::size_t done) {
    constexpr auto kQuiet = std::chrono::seconds{1};
    constexpr auto kPeriod = std::chrono::milliseconds{200};
    const auto now = std::chrono::steady_clock::now();
    if (!is_terminal_ || now - started_ < kQuiet || now - shown_ < kPeriod || total_ == 0) return;
    shown_ = now;
    std::fprintf(stderr, "\r%s %3zu %%", what_, 100 * done / total_);
  }

  void finish() const {
    if (shown_ != std::chrono::steady_clock::time_point{}) std::fputs("\r\033[K", stderr);
  }

 private:
  const char* what_;
  std::size_t total_;
  bool is_terminal_;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point shown_{};
};

}  // namespace geoloc::apps
