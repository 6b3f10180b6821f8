// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/outputs.hpp"
#include "common/stop_signal.hpp"
#include "common/text_writer.hpp"
#include "fuse/fuse_options.hpp"
#include "geoloc/fleet/object_ids.hpp"
#include "geoloc/io/fleet/fleet_store.hpp"
#include "geoloc/io/host_clock.hpp"
#include "geoloc/io/live_page/live_page.hpp"
#include "geoloc/io/mqtt/mqtt_connection.hpp"
#include "geoloc/io/mqtt/summary_inbox.hpp"
#include "geoloc/io/recording/recording.hpp"

namespace geoloc::apps {

/// A fleet's summaries, from files, a broker and what was kept of them, and the map that is made of them.
class FleetService {
 public:
  /// Reads the files, and finds all that is wrong with the arguments: throws std::exception naming it.
  explicit FleetService(const FuseOptions& options);

  /// Fuses once, or whenever there is news until it is stopped. The map at the end.
  io::RunRecord run(const StopSignal& stop);

  /// Whether an output could not be written, or no database be reached.
  bool has_failed() const { return outputs_.has_failed(); }

 private:
  using Clock = std::chrono::steady_clock;

  void add_stores();
  void join_fleet();
  void add_outputs();
  void take_files();
  bool recall_database(const StopSignal& stop);
  void recall(const io::KeptFleet& kept);
  void take_new(FlightSummary summary, std::string bytes);
  void fuse_now();
  void follow(const StopSignal& stop);
  bool is_due(Clock::time_point now) const;
  void tell_verdicts();
  void tell_status();
  void tell_outputs();
  void say(const std::string& message);
  bool is_live() const { return connection_ != nullptr; }

  FuseOptions options_;
  std::vector<io::TrueTarget> truth_;
  TextWriter stderr_;
  io::HostClock clock_;
  HostTime started_at_;
  Outputs outputs_;
  std::string name_;                    // of the fleet
  std::shared_ptr<io::LivePage> page_;  // nullptr where none is wanted
  std::optional<io::SummaryInbox> inbox_;
  std::unique_ptr<io::MqttConnection> connection_;
  std::vector<std::shared_ptr<io::SummaryOutbox>> outboxes_;
  Fleet fleet_;
  ObjectIds ids_;
  io::RunRecord run_;
  bool has_news_ = false;
  Clock::time_point posted_at_{}, told_at_{};
  std::size_t repeats_ = 0;  // of the last map
  Clock::duration fusion_took_{};
  std::uint64_t statuses_ = 0, refusals_told_ = 0;
  std::map<std::string, std::string> verdicts_;  // as told last, by flight
};

}  // namespace geoloc::apps
