// SPDX-License-Identifier: Apache-2.0
#include "sim/live_options.hpp"

namespace geoloc::sim {

void add_live_options(CLI::App& program, LiveOptions& options) {
  const auto add = [&program](const char* group, const char* name, auto& value, const char* help) {
    return program.add_option(name, value, help)->group(group);
  };
  constexpr const char* kLive = "Live (without --record and --images)";
  add(kLive, "--udp", options.udp, "Send MAVLink to this HOST:PORT")->capture_default_str();
  add(kLive, "--rtsp-port", options.rtsp_port, "Serve video at rtsp://127.0.0.1:PORT/cam; 0: any free port")
      ->capture_default_str();
  add(kLive, "--speed", options.speed, "Fly this many times as fast as was flown")->capture_default_str();
  add(kLive, "--wait-s", options.wait_s, "Wait so long for video and MAVLink clients before the flight, s")
      ->capture_default_str();
  add(kLive, "--distractors", options.distractors, "Things on the ground that look like targets")
      ->capture_default_str();
  add(kLive, "--truth", options.truth_file, "Write the true targets to this GeoJSON file");

  constexpr const char* kFaults = "Faults of the MAVLink link (live)";
  add(kFaults, "--loss", options.link.loss, "Share of the datagrams lost, each way")->capture_default_str();
  add(kFaults, "--link-delay-s", options.link.delay_s, "Least delay, each way, s")->capture_default_str();
  add(kFaults, "--link-jitter-s", options.link.jitter_s, "Mean of the exponential extra delay, s")
      ->capture_default_str();
  add(kFaults, "--reboot-at", options.reboot_at_s,
      "The autopilot reboots so long after the start, s of real time [never]");
}

}  // namespace geoloc::sim
