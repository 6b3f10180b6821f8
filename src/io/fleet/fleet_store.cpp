// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/fleet/fleet_store.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <system_error>

#include "geoloc/io/atomic_file.hpp"
#include "geoloc/io/fleet/summary_file.hpp"
#include "geoloc/io/text_file.hpp"

namespace geoloc::io {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using nlohmann::ordered_json;

constexpr const char* kIdsFormat = "geoloc object ids";
constexpr int kIdsVersion = 1;
constexpr const char* kIdsFile = "ids.json";
constexpr const char* kSummaryEnd = ".fs";
constexpr std::size_t kLargestIds = std::size_t{256} << 20;
/// Ids fit a database's bigint, and JSON's numbers.
constexpr std::uint64_t kMostId = std::uint64_t{1} << 53;

std::optional<std::uint64_t> number_of(const std::string& text) {
  std::uint64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [stopped_at, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || stopped_at != end) return std::nullopt;
  return number;
}

std::uint64_t id_of(const json& value, const std::string& name) {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() == 0 || value.get<std::uint64_t>() > kMostId)
    throw std::runtime_error(name + ": an id must be a whole number from 1");
  return value.get<std::uint64_t>();
}

void read_flight(const std::string& flight, const json& objects, const std::string& name, ObjectIds& ids) {
  if (!is_flight_name(flight) || !objects.is_object())
    throw std::runtime_error(name + ": a flight must be named as flights are, and hold its objects");
  for (const auto& [object, id] : objects.items()) {
    const auto number = number_of(object);
    if (!number) throw std::runtime_error(name + ": an object must be called by a number");
    ids.of[flight][*number] = id_of(id, name);
    ids.next = std::max(ids.next, id.get<std::uint64_t>() + 1);
  }
}

}  // namespace

std::string ids_to_json(const ObjectIds& ids) {
  auto flights = ordered_json::object();
  for (const auto& [flight, objects] : ids.of) {
    ordered_json& list = flights[flight] = ordered_json::object();
    for (const auto& [object, id] : objects) list[std::to_string(object)] = id;
  }
  const ordered_json document{
      {"format", kIdsFormat}, {"version", kIdsVersion}, {"next", ids.next}, {"flights", std::move(flights)}};
  return document.dump(1) + "\n";
}

ObjectIds ids_from_json(std::string_view text, const std::string& name) {
  const json document = json::parse(text, nullptr, false);
  if (!document.is_object() || document.value("format", json()) != kIdsFormat)
    throw std::runtime_error(name + ": is no list of objects' ids, or was cut off");
  if (document.value("version", json()) != kIdsVersion)
    throw std::runtime_error(name + ": is of another version");
  ObjectIds ids;
  const json flights = document.value("flights", json());
  if (!flights.is_object()) throw std::runtime_error(name + ": flights must be an object");
  for (const auto& [flight, objects] : flights.items()) read_flight(flight, objects, name, ids);
  ids.next = std::max(ids.next, id_of(document.value("next", json()), name));
  return ids;
}

KeptFleet read_fleet_folder(const fs::path& folder) {
  std::error_code fault;
  fs::create_directories(folder, fault);
  KeptFleet kept;
  std::vector<fs::path> files;
  for (fs::directory_iterator entry(folder, fault), end; !fault && entry != end; entry.increment(fault)) {
    if (entry->path().extension() == kSummaryEnd) files.push_back(entry->path());
  }
  if (fault) throw std::runtime_error(folder.string() + ": " + fault.message());
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    try {
      kept.summaries.push_back(read_summary(file));
    } catch (const std::runtime_error& error) {
      kept.faults.emplace_back(error.what());
    }
  }
  const fs::path ids = folder / kIdsFile;
  if (fs::exists(ids, fault)) kept.ids = ids_from_json(read_text_file(ids, kLargestIds), ids.string());
  return kept;
}

void FleetFolderSink::on_run(const RunRecord& run) {
  const SummaryOutbox::Summaries summaries = outbox_->take();
  try {
    for (const auto& [flight, bytes] : summaries)
      write_file_atomically(folder_ / (flight + kSummaryEnd), *bytes);
    if (run.object_ids) {
      std::string ids = ids_to_json(*run.object_ids);
      if (ids != ids_) write_file_atomically(folder_ / kIdsFile, ids);
      ids_ = std::move(ids);
    }
  } catch (...) {
    outbox_->put_back(summaries);
    throw;
  }
  outbox_->note_kept();
}

}  // namespace geoloc::io
