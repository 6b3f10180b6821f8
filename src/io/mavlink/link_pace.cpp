// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/link_pace.hpp"

#include <algorithm>
#include <chrono>

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;

/// Length of the windows by which the link is judged.
constexpr Duration kWindow = 5s;
/// A radio of 57,600 baud takes 50 ms and more, Ethernet, Wi-Fi and a fast serial port 1 to 20 ms.
constexpr Duration kShortTrip = 30ms;
constexpr std::size_t kLeastTrips = 3;
/// More lost messages than before, as a share, show that they are too many.
constexpr double kMoreLost = 0.02;
/// Windows that the fast rate is given to come.
constexpr int kWindowsToTakeEffect = 2;
constexpr Duration kLongestPause = 16min;

}  // namespace

void LinkPace::restart() {
  *this = LinkPace{};
}

void LinkPace::on_round_trip(Duration trip) {
  trips_[trip_count_++ % kTrips] = trip;
}

bool LinkPace::update(HostTime now, const Heard& heard) {
  if (window_end_ && now < *window_end_) return false;
  const bool was_fast = is_fast_;
  if (window_end_) {
    const auto frames = static_cast<double>(heard.frames - at_begin_.frames);
    const auto lost = static_cast<double>(heard.lost - at_begin_.lost);
    ++windows_;
    const double lost_share = lost / std::max(1.0, frames + lost);
    if (is_fast_) {
      if (!bears_it(heard, lost_share)) give_up(now);
    } else if (is_quick() && (!pause_until_ || now >= *pause_until_)) {
      try_fast(lost_share);
    }
  }
  window_end_ = now + kWindow;
  at_begin_ = heard;
  trip_count_ = 0;
  return is_fast_ != was_fast;
}

bool LinkPace::bears_it(const Heard& heard, double lost_share) const {
  const bool has_come = heard.is_fast || windows_ < kWindowsToTakeEffect;
  return has_come && is_quick() && lost_share <= usually_lost_ + kMoreLost;
}

void LinkPace::try_fast(double lost_share) {
  is_fast_ = true;
  windows_ = 0;
  usually_lost_ = lost_share;
}

void LinkPace::give_up(HostTime now) {
  is_fast_ = false;
  pause_until_ = now + pause_;
  pause_ = std::min<Duration>(2 * pause_, kLongestPause);
}

bool LinkPace::is_quick() const {
  const auto trip = usual_trip();
  return trip && *trip <= kShortTrip;
}

/// Median of the window's trips; nullopt where there are too few.
std::optional<Duration> LinkPace::usual_trip() const {
  const std::size_t count = std::min(trip_count_, kTrips);
  if (count < kLeastTrips) return std::nullopt;
  auto trips = trips_;
  const auto middle = trips.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(trips.begin(), middle, trips.begin() + static_cast<std::ptrdiff_t>(count));
  return *middle;
}

}  // namespace geoloc::io
