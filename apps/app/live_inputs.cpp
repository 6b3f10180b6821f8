// SPDX-License-Identifier: Apache-2.0
#include "app/live_inputs.hpp"

#include <stdexcept>
#include <utility>

#include "geoloc/io/recording/recording_reader.hpp"
#include "geoloc/io/video/file_source.hpp"
#include "geoloc/io/video/rtsp_source.hpp"

namespace geoloc::apps {
namespace {

std::unique_ptr<io::VideoSource> make_video_source(const LiveOptions& options, const io::VideoConfig& config,
                                                   const io::HostClock& clock,
                                                   const std::shared_ptr<io::HeldVideo>& passed_on) {
  if (options.rtsp_url.empty() == options.video_file.empty()) {
    throw std::invalid_argument("give one of --rtsp URL and --video FILE");
  }
  if (!options.rtsp_url.empty())
    return std::make_unique<io::RtspSource>(options.rtsp_url, config, clock, passed_on);
  return std::make_unique<io::FileSource>(options.video_file, io::Playback{}, config, clock, passed_on);
}

void add_line(const std::string& line, std::string& text) {
  if (!line.empty()) text += (text.empty() ? "" : "\n") + line;
}

/// A run whose video carries telemetry needs no port: one that nobody asked for may be taken.
void open_socket(const LiveOptions& options, LiveInputs& inputs) {
  try {
    inputs.socket = std::make_unique<io::UdpSocket>(io::parse_udp_endpoint(options.udp));
  } catch (const std::runtime_error& error) {
    if (options.is_udp_given) throw;
    add_line(std::string(error.what()) + ": only telemetry in the video can be used", inputs.remarks);
  }
}

void guard_link(LiveInputs& inputs) {
  const io::MavlinkConfig& config = inputs.config.estimation.mavlink;
  std::optional<io::LinkSigning> signing;
  if (!config.signing_key_file.empty()) {
    const io::SigningKey key = read_signing_key(config.signing_key_file);
    inputs.signing_store = std::make_unique<SigningStore>(signing_state_file(config));
    signing.emplace(key, inputs.signing_store->known());
  }
  inputs.guard = std::make_unique<io::LinkGuard>(config, signing);
}

}  // namespace

LiveInputs open_inputs(const LiveOptions& options, const io::HostClock& clock) {
  LiveInputs inputs;
  std::string faults;
  const auto attempt = [&faults](const auto& step) {
    try {
      step();
    } catch (const std::exception& error) {
      faults += (faults.empty() ? "" : "\n") + std::string(error.what());
    }
  };
  attempt([&] {
    LoadedConfig loaded = load_config(options);
    inputs.config = std::move(loaded.config);
    inputs.remarks = std::move(loaded.remarks);
  });
  attempt([&] { check_outputs(files_of(options.outputs), inputs_of(options)); });
  attempt([&] {
    if (!options.truth_file.empty()) inputs.truth = io::read_truth(options.truth_file);
  });
  attempt([&] {
    const io::DetectorFiles files = detector_files(options.detector);
    const double configured = inputs.config.detection.confidence;
    inputs.config.detection = io::with_model_defaults(files, inputs.config.detection);
    inputs.detector = io::open_detector(files, inputs.config.detection);
    add_line(confidence_note(options.detector, configured, inputs.config.detection.confidence),
             inputs.remarks);
  });
  attempt([&] { open_socket(options, inputs); });
  attempt([&] { guard_link(inputs); });
  if (!options.outputs.klv.empty()) inputs.passed_on = std::make_shared<io::HeldVideo>();
  attempt([&] { inputs.video = make_video_source(options, inputs.config.video, clock, inputs.passed_on); });
  if (!faults.empty()) throw std::runtime_error(faults);
  return inputs;
}

}  // namespace geoloc::apps
