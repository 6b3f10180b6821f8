// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "geoloc/io/fleet/fleet_store.hpp"
#include "geoloc/io/fleet/summary_outbox.hpp"
#include "geoloc/io/output/result_file.hpp"
#include "geoloc/io/output/sink.hpp"

namespace geoloc::io {

/// A fleet in a PostGIS database (docs/formats.md has its tables). It connects when it is used, and again
/// after a connection was lost.
class FleetDatabase {
 public:
  /// `url`: as libpq takes it, postgresql://USER@HOST/DATABASE?sslmode=verify-full. Throws
  /// std::invalid_argument where it is none, or holds a password, which every user of the computer could
  /// read.
  FleetDatabase(const std::string& url, std::string fleet);
  ~FleetDatabase();
  FleetDatabase(FleetDatabase&&) noexcept;
  FleetDatabase& operator=(FleetDatabase&&) = delete;

  /// Makes what tables are missing. Throws std::runtime_error with the server's reason.
  KeptFleet read();

  /// All of it or nothing. Throws std::runtime_error with the server's reason.
  void write(const SummaryOutbox::Summaries& summaries, const RunRecord& run);

  /// For messages: host and database.
  const std::string& name() const;
  /// Whether the connection goes to another computer unencrypted.
  bool is_exposed() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Keeps a fleet and its map in the database.
class PostgisSink final : public Sink {
 public:
  PostgisSink(FleetDatabase database, std::shared_ptr<SummaryOutbox> outbox)
      : database_(std::move(database)), outbox_(std::move(outbox)) {}

  std::string name() const override { return "--postgis " + database_.name(); }
  bool wants_frames() const override { return false; }
  void on_run(const RunRecord& run) override;

 private:
  FleetDatabase database_;
  std::shared_ptr<SummaryOutbox> outbox_;
};

}  // namespace geoloc::io
