// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/output_options.hpp"
#include "common/outputs.hpp"
#include "common/replay_pace.hpp"
#include "common/session.hpp"
#include "common/stop_signal.hpp"
#include "geoloc/io/live_page/live_page.hpp"
#include "geoloc/io/live_page/replay_control.hpp"
#include "geoloc/io/recording/recording_reader.hpp"

namespace geoloc::apps {

/// What is replayed, and how.
struct ShowSource {
  const io::Recording& recording;
  const EstimationConfig& config;
  const std::vector<io::TrueTarget>& truth;
  std::string title;
  const OutputOptions& outputs;
};

/// Plays a recording: to the outputs once and in order, and to the page as often as its readers go back.
/// Going back means computing anew from the beginning, which gives the same results.
class ReplayShow {
 public:
  /// All must outlive it. `page` is nullptr where nobody watches.
  ReplayShow(const ShowSource& source, Outputs& outputs, io::LivePage* page, io::ReplayControl& playback);

  /// Until the recording's end was reached, or a stop.
  void play_to_end(const StopSignal& stop);

  /// The end, as the outputs tell it.
  void show_end();

  /// After the end: plays again where a reader of the page wishes, until the recording's end or a stop.
  void play_again(const StopSignal& stop);

  const Session& session() const { return *session_; }
  Session& session() { return *session_; }

 private:
  bool play_once(const StopSignal& stop);
  void show(const PendingFrame& frame, bool is_located);
  bool goes_on(HostTime at, const StopSignal& stop);
  void tell_fleet();
  bool is_seeking(HostTime at) const { return seek_to_ && at < *seek_to_; }
  void begin_anew();
  io::RunRecord record() const;

  ShowSource source_;
  Outputs& outputs_;
  io::LivePage* page_;
  io::ReplayControl& playback_;
  io::FrameReporter reporter_;
  std::optional<Session> session_;
  ReplayPace pace_;
  std::size_t posted_ = 0;           // frames that the outputs have
  std::optional<HostTime> seek_to_;  // until there, nothing waits
  std::optional<std::chrono::steady_clock::time_point> record_shown_at_, fleet_told_at_;
};

}  // namespace geoloc::apps
