// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/sink_runner.hpp"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <utility>
#include <variant>

namespace geoloc::io {

struct SinkRunner::State {
  using Item = std::variant<std::shared_ptr<const OutputFrame>, std::shared_ptr<const LiveStatus>,
                            std::shared_ptr<const RunRecord>>;

  State(std::unique_ptr<Sink> its_sink, const SinkRunnerConfig& its_config, Tell its_tell)
      : sink(std::move(its_sink)), config(its_config), tell(std::move(its_tell)), name(sink->name()) {}

  void run();
  void post(Item item);
  bool wait_until(std::unique_lock<std::mutex>& lock, const std::function<bool()>& holds);

  const std::unique_ptr<Sink> sink;
  const SinkRunnerConfig config;
  const Tell tell;
  const std::string name;

  std::mutex mutex;  // guards what follows
  std::condition_variable has_work;
  std::condition_variable has_moved;
  std::deque<Item> queue;
  std::uint64_t moves = 0;  // calls that returned
  bool is_closed = false;
  bool is_done = false;
  bool has_waited_in_vain = false;
  Stats stats;

 private:
  void drop_oldest();
  void call(const Item& item);
  void guarded(const std::function<void()>& step, bool is_run);

  std::string last_error_;  // used by the thread only
};

void SinkRunner::State::run() {
  std::unique_lock lock(mutex);
  while (true) {
    has_work.wait(lock, [this] { return !queue.empty() || is_closed; });
    if (queue.empty()) break;
    const Item item = std::move(queue.front());
    queue.pop_front();
    lock.unlock();
    call(item);
    lock.lock();
    ++moves;
    has_moved.notify_all();
  }
  lock.unlock();
  guarded([this] { sink->on_end(); }, false);
  lock.lock();
  is_done = true;
  has_moved.notify_all();
}

void SinkRunner::State::call(const Item& item) {
  const bool is_run = std::holds_alternative<std::shared_ptr<const RunRecord>>(item);
  guarded(
      [&] {
        if (const auto* frame = std::get_if<std::shared_ptr<const OutputFrame>>(&item)) {
          sink->on_frame(**frame);
        } else if (const auto* status = std::get_if<std::shared_ptr<const LiveStatus>>(&item)) {
          sink->on_status(**status);
        } else {
          sink->on_run(*std::get<std::shared_ptr<const RunRecord>>(item));
        }
      },
      is_run);
}

void SinkRunner::State::guarded(const std::function<void()>& step, bool is_run) {
  std::string error;
  try {
    step();
  } catch (const std::exception& thrown) {
    error = thrown.what();
  }
  {
    const std::lock_guard lock(mutex);
    if (!error.empty()) {
      ++stats.failures;
      stats.error = error;
    }
    if (is_run) {
      stats.has_lost_run = !error.empty();  // a run includes everything before it
    } else if (!error.empty()) {
      stats.has_lost_frames = true;
    }
  }
  if (!error.empty() && error != last_error_) tell(error);
  if (!error.empty() || is_run) last_error_ = error;
}

void SinkRunner::State::drop_oldest() {
  const auto oldest = std::find_if(queue.begin(), queue.end(), [](const Item& item) {
    return !std::holds_alternative<std::shared_ptr<const RunRecord>>(item);
  });
  if (oldest == queue.end()) return;
  queue.erase(oldest);
  if (++stats.dropped == 1) tell(name + ": too slow, frames are left out");
}

bool SinkRunner::State::wait_until(std::unique_lock<std::mutex>& lock, const std::function<bool()>& holds) {
  while (!holds()) {
    const std::uint64_t seen = moves;
    if (!has_moved.wait_for(lock, config.patience, [&] { return moves != seen || holds(); })) return false;
  }
  return true;
}

void SinkRunner::State::post(Item item) {
  std::unique_lock lock(mutex);
  if (is_closed) return;
  const auto has_room = [this] { return queue.size() < config.queue_length; };
  if (has_room()) has_waited_in_vain = false;
  if (config.when_full == WhenFull::kWait && !has_waited_in_vain)
    has_waited_in_vain = !wait_until(lock, has_room);
  if (!has_room()) drop_oldest();
  queue.push_back(std::move(item));
  has_work.notify_one();
}

SinkRunner::SinkRunner(std::unique_ptr<Sink> sink, const SinkRunnerConfig& config, Tell tell)
    : name_(sink->name()),
      state_(std::make_shared<State>(std::move(sink), config, std::move(tell))),
      thread_([state = state_] { state->run(); }) {}

SinkRunner::~SinkRunner() {
  finish();
}

void SinkRunner::post(std::shared_ptr<const OutputFrame> frame) {
  state_->post(std::move(frame));
}

void SinkRunner::post(std::shared_ptr<const LiveStatus> status) {
  state_->post(std::move(status));
}

void SinkRunner::post(std::shared_ptr<const RunRecord> run) {
  {
    const std::lock_guard lock(state_->mutex);
    auto& queue = state_->queue;
    queue.erase(std::remove_if(queue.begin(), queue.end(),
                               [](const State::Item& item) {
                                 return std::holds_alternative<std::shared_ptr<const RunRecord>>(item);
                               }),
                queue.end());
  }
  state_->post(std::move(run));
}

void SinkRunner::close() {
  const std::lock_guard lock(state_->mutex);
  state_->is_closed = true;
  state_->has_work.notify_one();
}

void SinkRunner::finish() {
  if (!thread_.joinable()) return;
  close();
  std::unique_lock lock(state_->mutex);
  const bool is_done = state_->wait_until(lock, [this] { return state_->is_done; });
  state_->stats.is_stuck = !is_done;
  lock.unlock();
  if (is_done) {
    thread_.join();
  } else {
    thread_.detach();
  }
}

SinkRunner::Stats SinkRunner::stats() const {
  const std::lock_guard lock(state_->mutex);
  return state_->stats;
}

}  // namespace geoloc::io
