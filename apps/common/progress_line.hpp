// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>

namespace geoloc::apps {

/// A line that tells how far a long step is, silent for short ones: written anew in its place on a terminal,
/// and every few seconds elsewhere.
class ProgressLine {
 public:
  ProgressLine(const char* what, std::size_t total)
      : what_(what), total_(total), is_terminal_(::isatty(STDERR_FILENO) == 1) {}

  void show(std::size_t done) {
    constexpr auto kQuiet = std::chrono::seconds{1};
    constexpr auto kPeriod = std::chrono::milliseconds{200};
    constexpr auto kLogPeriod = std::chrono::seconds{5};
    const auto now = std::chrono::steady_clock::now();
    const auto since = now - std::max(shown_, started_);
    if (total_ == 0 || now - started_ < kQuiet || since < (is_terminal_ ? kPeriod : kLogPeriod)) return;
    shown_ = now;
    const std::size_t percent = 100 * done / total_;
    std::fprintf(stderr, is_terminal_ ? "\r%s %3zu %%" : "%s %zu %%\n", what_, percent);
  }

  void finish() const {
    if (is_terminal_ && shown_ != std::chrono::steady_clock::time_point{}) std::fputs("\r\033[K", stderr);
  }

 private:
  const char* what_;
  std::size_t total_;
  bool is_terminal_;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point shown_{};
};

}  // namespace geoloc::apps
