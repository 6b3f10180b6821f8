// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>

namespace geoloc::apps {

/// A line that tells how far a long step is, and how long it will take, silent for short ones: written anew
/// in its place on a terminal, and every few seconds elsewhere.
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
    const double share = static_cast<double>(done) / static_cast<double>(total_);
    const double passed_s = std::chrono::duration<double>(now - started_).count();
    std::fprintf(stderr, is_terminal_ ? "\r\033[K%s %3.0f %%, %s left" : "%s %.0f %%, %s left\n", what_,
                 100.0 * share, duration_text(passed_s * (1.0 - share) / std::max(share, 1e-3)).c_str());
  }

  void finish() const {
    if (is_terminal_ && shown_ != std::chrono::steady_clock::time_point{}) std::fputs("\r\033[K", stderr);
  }

 private:
  static std::string duration_text(double duration_s) {
    constexpr double kMinute_s = 60.0;
    const bool is_long = duration_s > 2.0 * kMinute_s;
    return std::to_string(std::lround(is_long ? duration_s / kMinute_s : duration_s)) +
           (is_long ? " min" : " s");
  }

  const char* what_;
  std::size_t total_;
  bool is_terminal_;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point shown_{};
};

}  // namespace geoloc::apps
