// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "geoloc/io/output/result_file.hpp"
#include "geoloc/io/output/sink.hpp"

namespace geoloc::io {

/// Writes the whole run so far to a file, which appears complete or not at all. A large file is written less
/// often, so that it takes a tenth of the time at most; the last run is always written.
class FileSink final : public Sink {
 public:
  using Render = std::function<std::string(const RunRecord&)>;
  using Clock = std::chrono::steady_clock;

  FileSink(std::string option, ResultFile file, Render render,
           std::function<Clock::time_point()> now = Clock::now)
      : option_(std::move(option)),
        file_(std::move(file)),
        render_(std::move(render)),
        now_(std::move(now)) {}

  std::string name() const override { return option_ + " " + file_.name().string(); }
  bool wants_frames() const override { return false; }

  void on_run(const RunRecord& run) override {
    if (now_() < next_) {
      waiting_ = run;
    } else {
      write(run);
    }
  }

  void on_end() override {
    if (const auto last = std::exchange(waiting_, std::nullopt)) write(*last);
  }

 private:
  static constexpr int kRest = 9;  ///< times as long as a file took
  static constexpr Clock::duration kLongestRest = std::chrono::minutes{1};

  void write(const RunRecord& run) {
    const Clock::time_point began = now_();
    waiting_.reset();
    file_.write(render_(run));
    const Clock::time_point ended = now_();
    next_ = ended + std::min<Clock::duration>(kRest * (ended - began), kLongestRest);
  }

  std::string option_;
  ResultFile file_;
  Render render_;
  std::function<Clock::time_point()> now_;
  Clock::time_point next_{};
  std::optional<RunRecord> waiting_;  ///< the newest that is not written
};

}  // namespace geoloc::io
