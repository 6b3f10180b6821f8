// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/socket.h>

#include <algorithm>
#include <list>
#include <mutex>
#include <utility>

namespace geoloc::io {

/// The clients whose request is not complete yet. Where there is no more room, the one that has taken longest
/// makes some: who opens many connections and dribbles loses his own, for an honest request comes in one
/// piece.
class OpenHeads {
 public:
  /// Within its life, the client's request is being read.
  class Reading {
   public:
    Reading(OpenHeads& heads, int client) : heads_(heads) {
      const std::lock_guard lock(heads_.mutex_);
      entry_ = heads_.clients_.insert(heads_.clients_.end(), client);
    }
    ~Reading() {
      const std::lock_guard lock(heads_.mutex_);
      heads_.clients_.erase(entry_);
    }
    Reading(const Reading&) = delete;
    Reading& operator=(const Reading&) = delete;

   private:
    OpenHeads& heads_;
    std::list<int>::iterator entry_;
  };

  /// False where no request is being read.
  bool end_oldest() {
    const std::lock_guard lock(mutex_);
    const auto oldest =
        std::find_if(clients_.begin(), clients_.end(), [](int client) { return client >= 0; });
    if (oldest == clients_.end()) return false;
    shutdown(std::exchange(*oldest, -1), SHUT_RDWR);  // its thread closes it
    return true;
  }

 private:
  std::mutex mutex_;
  std::list<int> clients_;  // the oldest first; negative: told to end
};

}  // namespace geoloc::io
