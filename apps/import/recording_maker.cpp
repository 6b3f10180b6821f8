// SPDX-License-Identifier: Apache-2.0
#include "import/recording_maker.hpp"

#include <nlohmann/json.hpp>
#include <system_error>

namespace geoloc::apps {
namespace {

/// A vehicle's clock that has jumped ahead, as it does between two pictures, is believed when three stamps
/// agree, by the link and by the state behind it (BootClockMonitor): of three pairs, the last is used by
/// both.
constexpr int kRepetitions = 3;

/// How pictures differ from a live run: each tells where it was taken itself. What is left of a latency is
/// how old a receiver's position is, which survey cameras with RTK know. And they are few: what is seen in
/// three or four must do (docs/import.md has what that costs).
nlohmann::ordered_json settings_for(const FlightPlan& plan) {
  constexpr double kReceiverLagSigma_s = 0.1, kCourseSigma_deg = 10.0, kConfirm = 0.99;
  nlohmann::ordered_json prior{{"sigma_latency_s", plan.is_synchronised ? 0.0 : kReceiverLagSigma_s}};
  if (plan.sigma_focal_percent > 0.0) prior["sigma_focal_percent"] = plan.sigma_focal_percent;
  if (plan.is_heading_assumed) prior["sigma_boresight_z_deg"] = kCourseSigma_deg;  // wind
  nlohmann::ordered_json joint{{"confirm_probability", kConfirm}, {"prior", std::move(prior)}};
  if (plan.sigma_attitude_deg > 0.0) joint["sigma_attitude_deg"] = plan.sigma_attitude_deg;
  return {{"joint", std::move(joint)}};
}

}  // namespace

RecordingMaker::~RecordingMaker() {
  std::error_code ignored;  // what cannot be removed stays as DIR.partial, which nobody takes for a recording
  if (!is_finished_) std::filesystem::remove_all(writer_.partial_folder(), ignored);
}

void RecordingMaker::write(const FlightPlan& plan, const PictureLooks& looks) {
  writer_.write_camera({plan.camera, plan.mount});
  writer_.write_config(settings_for(plan).dump(2));
  for (std::size_t i = 0; i < plan.exposures.size(); ++i) {
    const Exposure& exposure = plan.exposures[i];
    write_state(exposure);
    const auto& detections = looks.by_exposure.at(i);
    if (!detections) continue;
    io::RecordedFrame frame;
    frame.captured_at = exposure.at;
    frame.detections = *detections;
    frame.time_quality = "picture";
    frame.mount = exposure.mount;
    frame.focal_px = exposure.focal_px;
    writer_.add_frame(frame);
  }
}

void RecordingMaker::write_state(const Exposure& exposure) {
  const auto add = [&](const io::OutgoingFrame& frame) {
    writer_.add_telemetry(exposure.at, frame.bytes.data(), frame.size);
  };
  add(state_.heartbeat());
  if (exposure.gnss) add(state_.gnss(exposure.position, *exposure.gnss));
  for (int i = 0; i < kRepetitions; ++i) {
    add(state_.attitude(exposure.attitude));
    add(state_.position(exposure.position));
  }
}

void RecordingMaker::finish() {
  writer_.finish();
  is_finished_ = true;
}

}  // namespace geoloc::apps
