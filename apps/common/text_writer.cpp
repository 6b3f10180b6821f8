// SPDX-License-Identifier: Apache-2.0
#include "common/text_writer.hpp"

#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string_view>
#include <utility>

namespace geoloc::apps {
namespace {

/// Waits as long as it takes. False after an error.
bool write_whole(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written >= 0) {
      text.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno == EAGAIN) {  // another program has made it non-blocking
      pollfd waiting{descriptor, POLLOUT, 0};
      ::poll(&waiting, 1, -1);
    } else if (errno != EINTR) {
      return false;
    }
  }
  return true;
}

}  // namespace

struct TextWriter::State {
  State(int its_descriptor, std::size_t its_bound) : descriptor(its_descriptor), most_waiting(its_bound) {}

  void run();

  const int descriptor;
  const std::size_t most_waiting;
  std::mutex mutex;  // guards what follows
  std::condition_variable has_work;
  std::condition_variable has_ended;
  std::deque<std::string> waiting;
  std::size_t left_out = 0;  // before the first of those
  bool is_closed = false;
  bool is_done = false;
  bool has_failed = false;
};

void TextWriter::State::run() {
  std::unique_lock lock(mutex);
  while (!has_failed) {
    has_work.wait(lock, [this] { return !waiting.empty() || is_closed; });
    if (waiting.empty()) break;
    std::string text = std::move(waiting.front());
    waiting.pop_front();
    if (const std::size_t count = std::exchange(left_out, 0); count > 0)
      text.insert(0, "\n(" + std::to_string(count) + " messages were left out: nobody read them)\n");
    lock.unlock();
    const bool is_written = write_whole(descriptor, text);
    lock.lock();
    has_failed = !is_written;
  }
  is_done = true;
  has_ended.notify_all();
}

TextWriter::TextWriter(int descriptor, std::size_t most_waiting)
    : state_(std::make_shared<State>(descriptor, most_waiting)),
      thread_([state = state_] { state->run(); }) {}

TextWriter::~TextWriter() {
  finish(std::chrono::seconds{1});
}

void TextWriter::post(std::string text) {
  const std::lock_guard lock(state_->mutex);
  if (state_->has_failed) return;
  if (state_->waiting.size() >= state_->most_waiting) {
    state_->waiting.pop_front();
    ++state_->left_out;
  }
  state_->waiting.push_back(std::move(text));
  state_->has_work.notify_one();
}

bool TextWriter::finish(std::chrono::milliseconds patience) {
  std::unique_lock lock(state_->mutex);
  if (thread_.joinable()) {
    state_->is_closed = true;
    state_->has_work.notify_one();
    state_->has_ended.wait_for(lock, patience, [this] { return state_->is_done; });
    if (state_->is_done) {
      lock.unlock();  // the thread still has to let go of it
      thread_.join();
      lock.lock();
    } else {
      thread_.detach();
    }
  }
  return state_->is_done && !state_->has_failed;
}

}  // namespace geoloc::apps
