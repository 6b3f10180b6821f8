// SPDX-License-Identifier: Apache-2.0
#include "sim/live_options.hpp"

#include "common/command_line.hpp"
#include "sim/option_groups.hpp"

namespace geoloc::sim {

void add_live_options(CLI::App& program, LiveOptions& options) {
  const auto add = [&program](const char* group, const char* name, auto& value, const char* help) {
    return program.add_option(name, value, help)->group(group);
  };
  add(kLiveGroup, "--udp", options.udp,
      "Send MAVLink to this HOST:PORT [127.0.0.1:14550; of --autopilot px4, 127.0.0.1:14540]")
      ->type_name("HOST:PORT");
  add(kLiveGroup, "--rtsp-port", options.rtsp_port,
      "Serve video at rtsp://127.0.0.1:PORT/cam; 0: any free port")
      ->check(apps::whole_number())
      ->capture_default_str();
  add(kLiveGroup, "--speed", options.speed, "Fly this many times as fast as was flown")
      ->capture_default_str();
  add(kLiveGroup, "--wait-s", options.wait_s,
      "Wait so long for video and MAVLink clients before the flight, s")
      ->capture_default_str();
  add(kLiveGroup, "--distractors", options.distractors, "Things on the ground that look like targets")
      ->capture_default_str();
  add(kLiveGroup, "--truth", options.truth_file, "Write the true targets to this GeoJSON file");

  add(kLinkGroup, "--loss", options.link.loss, "Share of the datagrams lost, each way")
      ->capture_default_str();
  add(kLinkGroup, "--link-delay-s", options.link.delay_s, "Least delay, each way, s")->capture_default_str();
  add(kLinkGroup, "--link-jitter-s", options.link.jitter_s, "Mean of the exponential extra delay, s")
      ->capture_default_str();
  add(kLinkGroup, "--reboot-at", options.reboot_at_s,
      "The autopilot reboots so long after the start, s of real time [never]");
}

}  // namespace geoloc::sim
