// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace geoloc::io {

/// Summaries on their way to where they are kept: from the thread that gets them to a sink's. Of each flight
/// the newest waits, so that it is no larger than the fleet.
class SummaryOutbox {
 public:
  using Bytes = std::shared_ptr<const std::string>;
  using Summaries = std::map<std::string, Bytes>;  ///< by flight

  void put(const std::string& flight, Bytes summary) {
    const std::lock_guard lock(mutex_);
    summaries_.insert_or_assign(flight, std::move(summary));
    is_behind_ = true;
  }

  Summaries take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(summaries_, {});
  }

  /// They could not be kept; those that have been replaced since need not be.
  void put_back(const Summaries& summaries) {
    const std::lock_guard lock(mutex_);
    summaries_.insert(summaries.begin(), summaries.end());
    is_behind_ = true;
  }

  /// All that was taken is kept, and what was made of it.
  void note_kept() {
    const std::lock_guard lock(mutex_);
    is_behind_ = !summaries_.empty();
  }

  /// Whether there is something that is not kept.
  bool is_behind() const { return is_behind_; }

 private:
  std::mutex mutex_;
  Summaries summaries_;
  std::atomic<bool> is_behind_{false};
};

}  // namespace geoloc::io
