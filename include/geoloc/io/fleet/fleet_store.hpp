// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geoloc/fleet/object_ids.hpp"
#include "geoloc/io/fleet/summary_outbox.hpp"
#include "geoloc/io/output/sink.hpp"

namespace geoloc::io {

/// What a service that fuses flights knows again after it was restarted.
struct KeptFleet {
  std::vector<FlightSummary> summaries;
  ObjectIds ids;
  std::vector<std::string> faults;  ///< what could not be read, and is left out
};

std::string ids_to_json(const ObjectIds& ids);
/// Throws std::runtime_error that names the source and what is wrong.
ObjectIds ids_from_json(std::string_view text, const std::string& name);

/// A folder with a file for each flight's latest summary (FLIGHT.fs), and ids.json. Each is written whole or
/// not at all. Throws std::runtime_error where the folder can neither be read nor made.
KeptFleet read_fleet_folder(const std::filesystem::path& folder);

/// Keeps a fleet in such a folder.
class FleetFolderSink final : public Sink {
 public:
  FleetFolderSink(std::filesystem::path folder, std::shared_ptr<SummaryOutbox> outbox)
      : folder_(std::move(folder)), outbox_(std::move(outbox)) {}

  std::string name() const override { return "--state " + folder_.string(); }
  bool wants_frames() const override { return false; }
  void on_run(const RunRecord& run) override;

 private:
  std::filesystem::path folder_;
  std::shared_ptr<SummaryOutbox> outbox_;
  std::string ids_;  // as written last
};

}  // namespace geoloc::io
