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

/// What to do with a frame for which the queue has no room.
enum class WhenFull {
  kDropOldest,  ///< live: never waits
  kWait  ///< replay: waits as long as the sink moves; once it has not for `patience`, drops the oldest too
};

struct SinkRunnerConfig {
  std::size_t queue_length = 256;  ///< frames
  WhenFull when_full = WhenFull::kDropOldest;
  std::chrono::milliseconds patience{5000};  ///< with a sink that does not move
};

/// Runs one sink in a thread of its own behind a bounded queue. What is posted comes out in order; of several
/// runs that wait, the newest alone.
class SinkRunner {
 public:
  struct Stats {
    std::uint64_t dropped = 0;     ///< frames and states
    std::uint64_t failures = 0;    ///< calls that threw
    bool has_lost_frames = false;  ///< a call for a frame, a state or the end threw
    bool has_lost_run = false;     ///< that for the last run did
    std::string error;             ///< what it said
    bool is_stuck = false;         ///< finish() left it behind in a call that did not return

    bool has_failed() const { return has_lost_frames || has_lost_run || is_stuck; }
  };

  /// For a user; called from any thread.
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

  /// Closes and waits while the sink moves. A sink that has not moved for `patience` is left behind with its
  /// thread, and takes nothing of the program with it.
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
