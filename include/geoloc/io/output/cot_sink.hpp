// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/io/output/cot_config.hpp"
#include "geoloc/io/output/cot_connection.hpp"
#include "geoloc/io/output/sink.hpp"

namespace geoloc::io {

/// Sends confirmed objects as Cursor on Target events: immediately, then every cot.period_s and at the end of
/// the run. Where there are more than a link bears, some after each frame, new ones first. An object that is
/// gone is sent once more as stale. Where cot.sensor_period_s says so, the vehicle
/// and what its camera sees go with them. An object's uid is `prefix.run.id`, where `run` is the time of the
/// run's first frame: it stays the same in a replay and is never that of another object.
class CotSink final : public Sink {
 public:
  CotSink(std::string target, const CotConfig& config, const CotConnection::Tell& tell);

  std::string name() const override { return "--cot " + target_; }
  void on_frame(const OutputFrame& frame) override;
  void on_status(const LiveStatus& status) override;
  void on_run(const RunRecord& run) override;
  void on_end() override;

  const CotConnection& connection() const { return connection_; }

 private:
  using Clock = CotConnection::Clock;

  struct Told {
    ObjectReport object;
    std::optional<Clock::time_point> at;  // nullopt: not on this connection
  };

  void send_view();
  void tell_all_again();
  void send_due(std::size_t most);
  template <typename IsWanted>
  std::size_t send_those(const IsWanted& is_wanted, std::uint64_t from, Clock::time_point now,
                         std::size_t most);
  void send_gone();
  void send(const ObjectReport& object, bool is_gone);

  std::string target_;
  CotConfig config_;
  CotConnection connection_;
  std::string run_;                 // of the uid
  std::optional<ViewReport> view_;  // the last one, until it is told
  HostTime view_at_;
  std::optional<Clock::time_point> view_sent_at_;
  std::vector<ObjectReport> objects_;   // in order of their ids
  std::uint64_t next_due_ = 0;          // where the next round begins
  std::map<std::uint64_t, Told> told_;  // by the object's id
  std::uint64_t connections_ = 0;       // when told_ was true
};

}  // namespace geoloc::io
