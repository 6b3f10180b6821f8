// SPDX-License-Identifier: Apache-2.0
#include "geoloc/state/home_datum.hpp"

#include <algorithm>
#include <cmath>

namespace geoloc {
namespace {

/// The heights' difference steps by less than that without meaning anything, or by what is usual: some
/// vehicles take the two heights from different sensors.
constexpr double kLeastStep_m = 0.3;
/// Rates from before a longer pause predict nothing. What then tells the home's step is that the difference
/// was constant to this much, over so many samples: both heights come from one estimate.
constexpr double kLongPause_s = 2.0;
constexpr double kOneEstimate_m = 0.05;
constexpr int kSamplesToKnow = 20;
/// A vehicle that was never higher has not begun its flight.
constexpr double kOnTheGround_m = 2.0;

}  // namespace

void HomeDatum::restart() {
  const std::uint64_t moves = moves_;
  *this = HomeDatum{};
  moves_ = moves;
}

double HomeDatum::above_first_home_m(VehicleTime time, double above_home_m, std::optional<double> msl_m) {
  if (msl_m && std::isfinite(*msl_m) && (!newest_ || time > newest_->time))
    return follow({time, above_home_m, *msl_m});
  const bool is_of_before = moved_at_ && time < *moved_at_;
  return above_home_m + (is_of_before ? moved_up_before_m_ : moved_up_m_);
}

double HomeDatum::follow(const Heights& now) {
  const double pause_s = newest_ ? seconds(now.time - newest_->time) : 0.0;
  const double step_m =
      newest_ ? (now.msl_m - now.above_home_m) - (newest_->msl_m - newest_->above_home_m) : 0.0;
  if (newest_ && is_home_moved(now, pause_s, step_m)) {
    moved_up_before_m_ = moved_up_m_;
    moved_at_ = now.time;
    const bool is_take_off = !has_flown_ && std::abs(now.above_home_m) < kOnTheGround_m;
    if (!is_take_off) {
      moved_up_m_ += step_m;
      ++moves_;
    }
    msl_rate_mps_ = (now.msl_m - newest_->msl_m) / pause_s;
    above_home_rate_mps_ = msl_rate_mps_;
    newest_ = now;
  } else {
    go_on(now, pause_s, step_m);
  }
  has_flown_ = has_flown_ || now.above_home_m > kOnTheGround_m;
  return now.above_home_m + moved_up_m_;
}

double HomeDatum::unusual_step_m() const {
  return std::max(kLeastStep_m, usual_step_m_.most());
}

/// The height that departs from its own prediction is the one that was changed.
bool HomeDatum::is_home_moved(const Heights& now, double pause_s, double step_m) const {
  if (std::abs(step_m) <= unusual_step_m()) return false;
  if (pause_s > kLongPause_s)
    return usual_step_m_.samples() >= kSamplesToKnow && usual_step_m_.mean() < kOneEstimate_m;
  const double by_home_m =
      std::abs(now.above_home_m - newest_->above_home_m - pause_s * above_home_rate_mps_);
  const double by_sea_m = std::abs(now.msl_m - newest_->msl_m - pause_s * msl_rate_mps_);
  return by_sea_m < 0.5 * by_home_m && by_home_m > 0.5 * std::abs(step_m);
}

void HomeDatum::go_on(const Heights& now, double pause_s, double step_m) {
  if (newest_) {
    above_home_rate_mps_ = (now.above_home_m - newest_->above_home_m) / pause_s;
    msl_rate_mps_ = (now.msl_m - newest_->msl_m) / pause_s;
    usual_step_m_.learn(std::abs(step_m), unusual_step_m());
  }
  newest_ = now;
}

}  // namespace geoloc
