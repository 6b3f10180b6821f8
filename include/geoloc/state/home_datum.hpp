// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "geoloc/geometry/time.hpp"
#include "geoloc/state/usual_distance.hpp"

namespace geoloc {

/// Keeps heights above the home of the flight's start, wherever the vehicle puts its home later: the ground
/// does not move with it. A moved home shows as a step of the height above home while the height above mean
/// sea level goes on as before. Where the latter steps, or there is none, nothing is concluded.
class HomeDatum {
 public:
  /// Height above the first home of a vehicle that reports these. Samples may come late.
  double above_first_home_m(VehicleTime time, double above_home_m, std::optional<double> msl_m);

  /// How far the home of now lies above the first one.
  double moved_up_m() const { return moved_up_m_; }

  /// How often home was moved.
  std::uint64_t moves() const { return moves_; }

  /// The vehicle's clock began anew, and its home with it.
  void restart();

 private:
  struct Heights {
    VehicleTime time;
    double above_home_m;
    double msl_m;
  };

  double follow(const Heights& now);
  double unusual_step_m() const;
  bool is_home_moved(const Heights& now, double pause_s, double step_m) const;
  void go_on(const Heights& now, double pause_s, double step_m);

  std::optional<Heights> newest_;
  double above_home_rate_mps_ = 0.0;
  double msl_rate_mps_ = 0.0;
  UsualDistance usual_step_m_;  // of the difference of both heights, from sample to sample
  bool has_flown_ = false;
  double moved_up_m_ = 0.0;
  double moved_up_before_m_ = 0.0;  // until moved_at_
  std::optional<VehicleTime> moved_at_;
  std::uint64_t moves_ = 0;
};

}  // namespace geoloc
