// SPDX-License-Identifier: Apache-2.0
#include "eval/run_progress.hpp"

namespace geoloc::apps {
namespace {

ProgressSample sample_of(const Session& session, const std::vector<io::TrueTarget>& truth) {
  const Score score = score_run(session, truth);
  ProgressSample sample;
  sample.rmse_m = score.rmse_m;
  if (score.targets > 0) sample.found_share = static_cast<double>(score.found) / score.targets;
  if (const auto calibration = session.geolocator().calibration()) {
    sample.latency_s = calibration->latency_s();
    sample.sigma_latency_s = calibration->sigma(CalibrationIndex::kLatency);
    sample.boresight_rad = calibration->boresight_rad().head<2>();
  }
  return sample;
}

}  // namespace

void RunProgress::observe(const Session& session, HostTime captured_at,
                          const std::vector<io::TrueTarget>& truth) {
  if (!began_at_) began_at_ = captured_at;
  const double since_s = seconds(captured_at - *began_at_);
  if (since_s < kPeriod_s * static_cast<double>(samples_.size())) return;
  const ProgressSample sample = sample_of(session, truth);
  while (kPeriod_s * static_cast<double>(samples_.size()) <= since_s) samples_.push_back(sample);
}

}  // namespace geoloc::apps
