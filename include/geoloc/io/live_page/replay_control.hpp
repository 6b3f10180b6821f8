// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <optional>
#include <string>

#include "geoloc/geometry/time.hpp"

namespace geoloc::io {

/// What a page asks of a replay; what it does not name stays.
struct ReplayWish {
  std::optional<bool> is_paused;
  std::optional<double> speed;  ///< times the recorded one
  std::optional<HostTime> at;   ///< where to go on, forwards or backwards
};

/// Reads "paused=0&speed=2.5&at=1795313538548": `at` in milliseconds since 1970. nullopt for anything else.
std::optional<ReplayWish> parse_replay_wish(const std::string& query);

/// How a recording is to be played: wished by pages, done by the program. Thread-safe.
class ReplayControl {
 public:
  struct State {
    bool is_paused = false;
    double speed = 1.0;            ///< 0: as fast as it computes
    std::optional<HostTime> seek;  ///< wished and not yet taken
  };

  /// The recording's first and last frame.
  ReplayControl(HostTime begin, HostTime end, double speed);

  void wish(const ReplayWish& wish);
  State state() const;

  /// Where to go on, once.
  std::optional<HostTime> take_seek();

  /// JSON for pages: where the replay is, and how it goes on.
  std::string json(HostTime at, bool is_seeking) const;

 private:
  const HostTime begin_;
  const HostTime end_;
  mutable std::mutex mutex_;  // guards what follows
  State state_;
};

}  // namespace geoloc::io
