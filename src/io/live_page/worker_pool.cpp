// SPDX-License-Identifier: Apache-2.0
#include "worker_pool.hpp"

#include <system_error>
#include <utility>

namespace geoloc::io {

WorkerPool::WorkerPool(std::size_t most_threads) : most_threads_(most_threads) {}

WorkerPool::~WorkerPool() {
  finish();
}

bool WorkerPool::try_run(std::function<void()> job) {
  const std::lock_guard lock(mutex_);
  if (is_finishing_) return false;
  if (idle_ <= jobs_.size()) {
    if (threads_.size() >= most_threads_) return false;
    try {
      threads_.emplace_back([this] { work(); });
    } catch (const std::system_error&) {  // the system has no more threads
      return false;
    }
    ++idle_;
  }
  jobs_.push_back(std::move(job));
  has_job_.notify_one();
  return true;
}

void WorkerPool::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    has_job_.wait(lock, [this] { return !jobs_.empty() || is_finishing_; });
    if (jobs_.empty()) return;
    const std::function<void()> job = std::move(jobs_.front());
    jobs_.pop_front();
    --idle_;
    lock.unlock();
    job();
    lock.lock();
    ++idle_;
  }
}

void WorkerPool::finish() {
  {
    const std::lock_guard lock(mutex_);
    is_finishing_ = true;
    has_job_.notify_all();
  }
  for (std::thread& thread : threads_) {
    if (thread.joinable()) thread.join();
  }
}

}  // namespace geoloc::io
