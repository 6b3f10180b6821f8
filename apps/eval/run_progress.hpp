// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "common/run_score.hpp"
#include "common/session.hpp"

namespace geoloc::apps {

/// A run some time after its first frame.
struct ProgressSample {
  std::optional<double> rmse_m;  ///< over the targets found until then
  double found_share = 0.0;      ///< of the targets
  std::optional<double> latency_s;
  std::optional<double> sigma_latency_s;
  std::optional<Eigen::Vector2d> boresight_rad;  ///< about the camera's x and y
};

/// Samples of a run at equal intervals of the recording's time.
class RunProgress {
 public:
  static constexpr double kPeriod_s = 2.0;

  /// After each frame, located or not.
  void observe(const Session& session, HostTime captured_at, const std::vector<io::TrueTarget>& truth);

  /// That of index i: i * kPeriod_s after the first frame.
  const std::vector<ProgressSample>& samples() const { return samples_; }

 private:
  std::optional<HostTime> began_at_;
  std::vector<ProgressSample> samples_;
};

}  // namespace geoloc::apps
