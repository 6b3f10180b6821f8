// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace geoloc::io {

/// A pool of threads that are started as needed, up to a limit.
class WorkerPool {
 public:
  explicit WorkerPool(std::size_t most_threads);
  /// finish().
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// Runs a job in a free thread; returns false without running it if every thread is busy. A job must not
  /// throw.
  bool try_run(std::function<void()> job);

  /// Waits for all jobs.
  void finish();

 private:
  void work();

  const std::size_t most_threads_;
  std::mutex mutex_;  // guards what follows
  std::condition_variable has_job_;
  std::deque<std::function<void()>> jobs_;
  std::size_t idle_ = 0;
  bool is_finishing_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace geoloc::io
