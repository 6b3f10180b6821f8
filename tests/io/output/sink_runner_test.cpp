// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/sink_runner.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <vector>

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;

/// A gate that the test opens.
class Gate {
 public:
  void open() {
    const std::lock_guard lock(mutex_);
    is_open_ = true;
    opened_.notify_all();
  }
  void pass() {
    std::unique_lock lock(mutex_);
    opened_.wait(lock, [this] { return is_open_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable opened_;
  bool is_open_ = false;
};

/// What a sink was given; shared, because a stuck sink outlives its runner.
struct Log {
  Gate gate;
  std::mutex mutex;
  std::vector<std::int64_t> frames_us;
  std::vector<std::string> runs;
  std::atomic<bool> has_ended{false};
};

class LoggingSink final : public Sink {
 public:
  LoggingSink(std::shared_ptr<Log> log, bool is_blocked, bool throws)
      : log_(std::move(log)), is_blocked_(is_blocked), throws_(throws) {}
  std::string name() const override { return "log"; }
  void on_frame(const OutputFrame& frame) override {
    if (is_blocked_) log_->gate.pass();
    if (throws_) throw std::runtime_error("no");
    const std::lock_guard lock(log_->mutex);
    log_->frames_us.push_back(frame.captured_at.time_since_epoch().count() / 1000);
  }
  void on_run(const RunRecord& run) override {
    const std::lock_guard lock(log_->mutex);
    log_->runs.push_back(run.title);
  }
  void on_end() override { log_->has_ended = true; }

 private:
  std::shared_ptr<Log> log_;
  bool is_blocked_;
  bool throws_;
};

std::shared_ptr<const OutputFrame> frame_at(std::int64_t time_us) {
  OutputFrame frame;
  frame.captured_at = HostTime{std::chrono::microseconds{time_us}};
  return std::make_shared<const OutputFrame>(frame);
}

std::shared_ptr<const RunRecord> run_called(const char* title) {
  RunRecord run;
  run.title = title;
  return std::make_shared<const RunRecord>(run);
}

struct Runner {
  explicit Runner(SinkRunnerConfig config, bool is_blocked = false, bool throws = false)
      : sink(std::make_unique<LoggingSink>(log, is_blocked, throws), config,
             [said = said](const std::string& message) { said->push_back(message); }) {}
  ~Runner() { log->gate.open(); }

  std::shared_ptr<Log> log = std::make_shared<Log>();
  std::shared_ptr<std::vector<std::string>> said = std::make_shared<std::vector<std::string>>();
  SinkRunner sink;
};

TEST(SinkRunner, DeliversInOrderAndEnds) {
  Runner runner({1000});
  for (int i = 0; i < 500; ++i) runner.sink.post(frame_at(i));
  runner.sink.post(run_called("final"));
  runner.sink.finish();
  ASSERT_EQ(runner.log->frames_us.size(), 500U);
  for (int i = 0; i < 500; ++i) EXPECT_EQ(runner.log->frames_us[static_cast<std::size_t>(i)], i);
  EXPECT_EQ(runner.log->runs, std::vector<std::string>{"final"});
  EXPECT_TRUE(runner.log->has_ended);
  EXPECT_FALSE(runner.sink.stats().has_failed());
}

TEST(SinkRunner, ABlockedSinkNeitherHoldsUpThePosterNorTheEnd) {
  Runner runner({8, WhenFull::kDropOldest, 50ms}, true);
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 10'000; ++i) runner.sink.post(frame_at(i));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 1s);
  EXPECT_GE(runner.sink.stats().dropped, 10'000U - 8U - 1U);
  runner.sink.finish();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 3s);
  EXPECT_TRUE(runner.sink.stats().is_stuck);
  EXPECT_TRUE(runner.sink.stats().has_failed());
}

TEST(SinkRunner, ASlowSinkKeepsTheNewestFramesAndTheLastRun) {
  Runner runner({4}, true);
  runner.sink.post(run_called("early"));
  for (int i = 0; i < 100; ++i) runner.sink.post(frame_at(i));
  runner.sink.post(run_called("late"));
  runner.log->gate.open();
  runner.sink.finish();
  ASSERT_GE(runner.log->frames_us.size(), 3U);
  EXPECT_EQ(runner.log->frames_us.back(), 99);
  EXPECT_EQ(runner.log->runs.back(), "late");
  EXPECT_GT(runner.sink.stats().dropped, 0U);
}

TEST(SinkRunner, AReplayWaitsForASinkThatMoves) {
  Runner runner({4, WhenFull::kWait, 2000ms});
  for (int i = 0; i < 2000; ++i) runner.sink.post(frame_at(i));
  runner.sink.finish();
  EXPECT_EQ(runner.log->frames_us.size(), 2000U);
  EXPECT_EQ(runner.sink.stats().dropped, 0U);
}

TEST(SinkRunner, AReplayWaitsOnceForASinkThatDoesNot) {
  Runner runner({4, WhenFull::kWait, 100ms}, true);
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 1000; ++i) runner.sink.post(frame_at(i));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 2s);
}

TEST(SinkRunner, WhatASinkThrowsIsToldOnceAndCounted) {
  Runner runner({1000}, false, true);
  for (int i = 0; i < 10; ++i) runner.sink.post(frame_at(i));
  runner.sink.finish();
  EXPECT_EQ(runner.sink.stats().failures, 10U);
  EXPECT_TRUE(runner.sink.stats().has_failed());
  EXPECT_EQ(*runner.said, std::vector<std::string>{"no"});
}

}  // namespace
}  // namespace geoloc::io
