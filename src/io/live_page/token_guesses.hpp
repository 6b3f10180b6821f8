// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <mutex>
#include <string>

namespace geoloc::io {

/// Makes guessing a token slow: a network that has sent ten wrong ones has to wait until a minute after the
/// first. One that repeats the same wrong token, as a browser with an old cookie does, has sent one.
/// Thread-safe; memory is bounded.
class TokenGuesses {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::seconds kPeriod{60};
  static constexpr int kMostWrong = 10;
  static constexpr std::size_t kMostNetworks = 256;  ///< beyond, the oldest is forgotten

  bool may_try(const std::string& network, Time now);
  void note_wrong(const std::string& network, const std::string& token, Time now);

 private:
  struct Guesser {
    std::string network;
    Time began_at;
    int wrong = 0;
    std::size_t newest = 0;  // hash of the token
  };

  Guesser* find(const std::string& network, Time now);

  std::mutex mutex_;
  std::deque<Guesser> guessers_;  // the oldest first
};

}  // namespace geoloc::io
