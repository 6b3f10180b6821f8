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
  /// `speed`: times the recorded one; 0 never waits.
  explicit ReplayPace(double speed) : speed_(speed) {}

  /// Waits until a frame of that time is due. A long hole in the recording is cut short.
  void wait_for(HostTime captured_at, const std::function<bool()>& is_stopped) {
    const Duration step = last_ ? captured_at - *last_ : Duration{};
    last_ = captured_at;
    if (speed_ <= 0.0) return;
    const double step_s = std::clamp(seconds(step), 0.0, kLongestStep_s) / speed_;
    due_ += std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(step_s));
    due_ = std::max(due_, Clock::now() - kLag);  // what was lost is not caught up with
    while (Clock::now() < due_ && !is_stopped())
      std::this_thread::sleep_until(std::min(due_, Clock::now() + kNap));
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr double kLongestStep_s = 2.0;
  static constexpr std::chrono::milliseconds kNap{50};
  static constexpr std::chrono::milliseconds kLag{500};

  double speed_;
  std::optional<HostTime> last_;
  Clock::time_point due_ = Clock::now();
};

}  // namespace geoloc::apps
