// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace geoloc::apps {

/// Lines for a user, from any thread to the one that owns the terminal. One that waits is not repeated.
class MessageBox {
 public:
  void post(const std::string& message) {
    const std::lock_guard lock(mutex_);
    const bool is_waiting = std::find(messages_.begin(), messages_.end(), message) != messages_.end();
    if (!is_waiting && messages_.size() < kMost) messages_.push_back(message);
  }

  std::vector<std::string> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(messages_, {});
  }

 private:
  static constexpr std::size_t kMost = 100;
  std::mutex mutex_;
  std::vector<std::string> messages_;
};

}  // namespace geoloc::apps
