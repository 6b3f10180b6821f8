// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>
#include <thread>

#include "geoloc/geometry/time.hpp"

namespace geoloc::apps {

/// Holds a replay to a multiple of the recorded speed.
class ReplayPace {
 public:
  /// What is wished at the moment.
  struct Wish {
    double speed = 1.0;  ///< times the recorded one; 0 never waits
    bool is_paused = false;
  };

  /// Waits until a frame of that time is due. `wish` is asked again and again; nullopt ends the wait. A long
  /// hole in the recording is cut short.
  void wait_for(HostTime captured_at, const std::function<std::optional<Wish>()>& wish) {
    const Duration step = last_ ? captured_at - *last_ : Duration{};
    last_ = captured_at;
    ahead_s_ += std::clamp(seconds(step), 0.0, kLongestStep_s);
    while (const auto now_wished = wish()) {
      const double passed_s = std::chrono::duration<double>(Clock::now() - asked_at_).count();
      asked_at_ = Clock::now();
      if (!now_wished->is_paused) {
        const double speed = now_wished->speed;
        // What was lost is not caught up with.
        ahead_s_ = speed > 0.0 ? std::max(ahead_s_ - passed_s * speed, -kLag_s * speed) : 0.0;
        if (ahead_s_ <= 0.0) return;
        std::this_thread::sleep_for(std::chrono::duration<double>(std::min(kNap_s, ahead_s_ / speed)));
      } else {
        std::this_thread::sleep_for(std::chrono::duration<double>(kNap_s));
      }
    }
  }

  /// Forgets where it was: the next frame is due at once.
  void begin_anew() {
    last_.reset();
    ahead_s_ = 0.0;
    asked_at_ = Clock::now();
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr double kLongestStep_s = 2.0;
  static constexpr double kNap_s = 0.05;
  static constexpr double kLag_s = 0.5;

  std::optional<HostTime> last_;
  double ahead_s_ = 0.0;  // of the recording, by which the last frame is early
  Clock::time_point asked_at_ = Clock::now();
};

}  // namespace geoloc::apps
