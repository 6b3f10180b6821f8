// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "geoloc/io/output/sink.hpp"

namespace geoloc::io {

/// What to do with a frame when the queue is full.
enum class WhenFull {
  kDropOldest,  ///< live: never waits
  kWait  ///< replay: waits while the sink makes progress; after `patience` without any, also drops the oldest
};

struct SinkRunnerConfig {
  std::size_t queue_length = 256;  ///< frames
  WhenFull when_full = WhenFull::kDropOldest;
  std::chrono::milliseconds patience{5000};  ///< with a sink that makes no progress
};

/// Runs one sink in a thread of its own behind a bounded queue. Posts are delivered in order; if several runs
/// are waiting, only the newest is.
class SinkRunner {
 public:
  struct Stats {
    std::uint64_t dropped = 0;     ///< frames and states
    std::uint64_t failures = 0;    ///< calls that threw
    bool has_lost_frames = false;  ///< a call for a frame, a state or the end threw
    bool has_lost_run = false;     ///< the call for the last run threw
    std::string error;             ///< what it said
    bool is_stuck = false;         ///< finish() abandoned it in a call that did not return

    bool has_failed() const { return has_lost_frames || has_lost_run || is_stuck; }
  };

  /// Shows a message to the user; called from any thread.
  using Tell = std::function<void(const std::string& message)>;

  SinkRunner(std::unique_ptr<Sink> sink, const SinkRunnerConfig& config, Tell tell);
  /// finish().
  ~SinkRunner();
  SinkRunner(const SinkRunner&) = delete;
  SinkRunner& operator=(const SinkRunner&) = delete;

  void post(std::shared_ptr<const OutputFrame> frame);
  void post(std::shared_ptr<const LiveStatus> status);
  void post(std::shared_ptr<const RunRecord> run);

  /// Nothing more will come; does not wait.
  void close();

  /// Closes and waits while the sink makes progress. A sink without progress for `patience` is abandoned with
  /// its thread, and shares nothing with the rest of the program.
  void finish();

  Stats stats() const;
  std::string name() const { return name_; }

 private:
  struct State;

  std::string name_;
  std::shared_ptr<State> state_;  // the thread's too: it may outlive this object
  std::thread thread_;
};

}  // namespace geoloc::io
