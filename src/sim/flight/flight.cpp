// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/flight/flight.hpp"

#include <algorithm>
#include <stdexcept>

#include "geoloc/sim/flight/mavlink_frame.hpp"
#include "truth_file.hpp"

namespace geoloc::sim {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTruthSuffix = "_truth.csv.gz";

/// The autopilot stamps a message when it makes it, so the least delayed one tells when its clock read zero.
std::optional<HostTime> boot_time(const io::Tlog& telemetry) {
  std::optional<HostTime> earliest;
  for (const io::TlogRecord& record : telemetry.records()) {
    const auto frame = view_frame(record.frame, record.size);
    if (!frame || frame->message_id != kAttitudeId || frame->payload_size < 4) continue;
    const HostTime booted = record.received_at - std::chrono::milliseconds{load_u32(frame->payload)};
    if (!earliest || booted < *earliest) earliest = booted;
  }
  return earliest;
}

std::string unknown_flight(const fs::path& folder, const std::string& name) {
  std::string message = "no flight '" + name + "' in " + folder.string() + "; there are:";
  for (const std::string& known : flight_names(folder)) message += " " + known;
  return message;
}

}  // namespace

std::optional<Rigid3d> Flight::enu_from_camera(VehicleTime time, const Rigid3d& carrier_from_camera) const {
  const auto enu_from_body = truth.pose(time);
  if (!enu_from_body) return std::nullopt;
  if (!gimbal) return *enu_from_body * carrier_from_camera;
  return Rigid3d{(gimbal->enu_from_gimbal(time) * carrier_from_camera.rotation).normalized(),
                 *enu_from_body * carrier_from_camera.translation};
}

Flight load_flight(const fs::path& folder, const std::string& name, const Site& site) {
  const std::vector<std::string> known = flight_names(folder);
  if (std::find(known.begin(), known.end(), name) == known.end()) {
    throw std::runtime_error(unknown_flight(folder, name));
  }
  io::Tlog telemetry = io::read_tlog(folder / (name + ".tlog"));
  const auto booted_at = boot_time(telemetry);
  if (!booted_at) throw std::runtime_error((folder / (name + ".tlog")).string() + ": holds no ATTITUDE");
  return {name, std::move(telemetry), Trajectory{read_truth_file(folder / (name + kTruthSuffix)), site},
          *booted_at};
}

std::vector<std::string> flight_names(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const fs::path& file = entry.path();
    if (file.extension() != ".tlog") continue;
    if (fs::exists(folder / (file.stem().string() + kTruthSuffix), error))
      names.push_back(file.stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

fs::path find_flights(const std::optional<fs::path>& given, const fs::path& program) {
  std::vector<fs::path> candidates;
  if (given) {
    candidates = {*given, *given / "flights"};
  } else {
    const fs::path folder = program.parent_path();  // <prefix>/bin, or <source>/build/<preset>/bin
    candidates = {folder / "../share/geoloc/flights", folder / "../../../data/flights", "data/flights"};
  }
  std::string looked_in;
  for (const fs::path& candidate : candidates) {
    if (!flight_names(candidate).empty()) return candidate.lexically_normal();
    looked_in += "\n  " + candidate.lexically_normal().string();
  }
  throw std::runtime_error("no flights found; give their folder with --data-dir. Looked in:" + looked_in);
}

}  // namespace geoloc::sim
