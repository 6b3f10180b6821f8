// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/live_options.hpp"
#include "app/signing_store.hpp"
#include "geoloc/io/detection/detector.hpp"
#include "geoloc/io/host_clock.hpp"
#include "geoloc/io/klv/held_video.hpp"
#include "geoloc/io/mavlink/link_guard.hpp"
#include "geoloc/io/mavlink/udp_socket.hpp"
#include "geoloc/io/recording/recording.hpp"
#include "geoloc/io/video/video_source.hpp"

namespace geoloc::apps {

/// What a run is made of.
struct LiveInputs {
  LiveConfig config;
  std::string remarks;  ///< on the configuration, for the user; may be empty
  std::vector<io::TrueTarget> truth;
  std::unique_ptr<io::Detector> detector;
  std::unique_ptr<io::UdpSocket> socket;        ///< nullptr: nobody asked for it, and the port is taken
  std::unique_ptr<SigningStore> signing_store;  ///< nullptr where nothing is signed
  std::unique_ptr<io::LinkGuard> guard;
  std::shared_ptr<io::HeldVideo> passed_on;  ///< the video as it came, for --klv; nullptr without
  std::unique_ptr<io::VideoSource> video;    ///< refers to the clock
};

/// Loads, binds and opens all of it. Throws std::runtime_error that lists everything that is wrong with
/// files, model, port and stream, each with its name and remedy.
LiveInputs open_inputs(const LiveOptions& options, const io::HostClock& clock);

}  // namespace geoloc::apps
