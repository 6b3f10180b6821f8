// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "byte_stream.hpp"
#include "geoloc/io/fleet/summary_file.hpp"
#include "part_bytes.hpp"
#include "summary_checks.hpp"

namespace geoloc::io {
namespace {

constexpr std::string_view kMagic = "geolocFS";
/// Magic, version, counts of objects, shared errors and pairs.
constexpr std::size_t kHeadBytes = 8 + 4 * sizeof(std::uint32_t);
constexpr std::size_t kChecksumBytes = sizeof(std::uint64_t);

void put_object(const FlightSummary& summary, std::size_t i, ByteWriter& writer) {
  const FlightSummary::Object& object = summary.objects[i];
  writer.put(object.id);
  writer.put(static_cast<std::int32_t>(object.hits));
  writer.put(object.existence);
  writer.put(std::int64_t{object.first_seen.time_since_epoch().count()});
  writer.put(std::int64_t{object.last_seen.time_since_epoch().count()});
  for (const ClassVotes::Vote& vote : object.class_votes.votes()) {
    writer.put(static_cast<std::int32_t>(vote.class_id));
    writer.put(vote.weight);
  }
  for (int row = 0; row < 3; ++row) writer.put(object.position_in_enu[row]);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column <= row; ++column) writer.put(object.own_covariance(row, column));
  }
  const auto shared = summary.shared_error_of(i);
  for (int row = 0; row < 3; ++row) {
    for (Eigen::Index column = 0; column < shared.cols(); ++column) writer.put(shared(row, column));
  }
}

/// What put_object() writes.
std::size_t object_bytes(std::size_t shared) {
  return 8 + 4 + 3 * 8 + 4 * (4 + 8) + (3 + 6) * 8 + 3 * shared * 8;
}

FlightSummary::Object take_object(std::size_t i, FlightSummary& summary, ByteReader& reader) {
  FlightSummary::Object object;
  object.id = reader.take<std::uint64_t>();
  object.hits = reader.take<std::int32_t>();
  object.existence = reader.take<double>();
  object.first_seen = HostTime{Duration{reader.take<std::int64_t>()}};
  object.last_seen = HostTime{Duration{reader.take<std::int64_t>()}};
  ClassVotes::Votes votes{};
  for (ClassVotes::Vote& vote : votes) {
    vote.class_id = reader.take<std::int32_t>();
    vote.weight = reader.take<double>();
  }
  object.class_votes = ClassVotes(votes);
  for (int row = 0; row < 3; ++row) object.position_in_enu[row] = reader.take<double>();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column <= row; ++column)
      object.own_covariance(row, column) = object.own_covariance(column, row) = reader.take<double>();
  }
  auto shared = summary.shared_error.middleRows<3>(3 * static_cast<Eigen::Index>(i));
  for (int row = 0; row < 3; ++row) {
    for (Eigen::Index column = 0; column < shared.cols(); ++column)
      shared(row, column) = reader.take<double>();
  }
  return object;
}

}  // namespace

/// FNV-1a, eight bytes at a time.
std::uint64_t summary_checksum(std::string_view bytes) {
  constexpr std::uint64_t kPrime = 1099511628211ULL;
  std::uint64_t sum = 14695981039346656037ULL;
  while (!bytes.empty()) {
    const std::size_t size = std::min<std::size_t>(8, bytes.size());
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data(), size);
    sum = (sum ^ word) * kPrime;
    sum ^= sum >> 32;
    bytes.remove_prefix(size);
  }
  return sum;
}

std::string summary_to_bytes(const FlightSummary& summary) {
  ByteWriter writer;
  writer.put_raw(kMagic);
  writer.put(version_of(summary));
  writer.put(static_cast<std::uint32_t>(summary.objects.size()));
  writer.put(static_cast<std::uint32_t>(summary.shared_count()));
  writer.put(static_cast<std::uint32_t>(summary.apart.size()));
  writer.put_text(summary.identity.flight);
  writer.put_text(summary.identity.vehicle);
  writer.put(summary.identity.sequence);
  writer.put(summary.origin.latitude_deg);
  writer.put(summary.origin.longitude_deg);
  writer.put(static_cast<std::uint8_t>(summary.home_height_msl_m ? 1 : 0));
  writer.put(summary.home_height_msl_m.value_or(0.0));
  for (std::size_t i = 0; i < summary.objects.size(); ++i) put_object(summary, i, writer);
  for (const auto& [first, second] : summary.apart) {
    writer.put(first);
    writer.put(second);
  }
  if (summary.part) put_part(*summary.part, writer);
  writer.put(summary_checksum(writer.bytes()));
  return writer.take();
}

FlightSummary summary_from_bytes(std::string_view bytes, const std::string& name) {
  if (bytes.substr(0, kMagic.size()) != kMagic) refuse_summary(name, "is not a flight summary");
  if (bytes.size() < kHeadBytes + kChecksumBytes) refuse_summary(name, "ends too early: it was cut off");
  ByteReader reader(bytes.substr(kMagic.size(), bytes.size() - kMagic.size() - kChecksumBytes), name);
  const auto version = reader.take<std::uint32_t>();
  refuse_other_version(name, version);
  const auto objects = reader.take<std::uint32_t>(), shared = reader.take<std::uint32_t>(),
             apart = reader.take<std::uint32_t>();
  refuse_absurd_sizes(name, objects, shared, apart);

  FlightSummary summary;
  summary.identity.flight = reader.take_text();
  summary.identity.vehicle = reader.take_text();
  summary.identity.sequence = reader.take<std::uint64_t>();
  summary.origin.latitude_deg = reader.take<double>();
  summary.origin.longitude_deg = reader.take<double>();
  const auto has_home = reader.take<std::uint8_t>();
  const auto home_height_msl_m = reader.take<double>();
  if (has_home > 1) refuse_summary(name, "tells neither that home's height is known nor that it is not");
  if (has_home == 1) summary.home_height_msl_m = home_height_msl_m;
  const std::size_t told = objects * object_bytes(shared) + apart * std::size_t{8};
  if (version == kPlainVersion ? reader.left() != told : reader.left() < told)
    refuse_summary(name, "is not as long as its counts say: it was cut off or damaged");
  if (summary_checksum(bytes.substr(0, bytes.size() - kChecksumBytes)) !=
      ByteReader(bytes.substr(bytes.size() - kChecksumBytes), name).take<std::uint64_t>())
    refuse_summary(name, "does not have its checksum: it was cut off or damaged");
  summary.shared_error.resize(3 * static_cast<Eigen::Index>(objects), static_cast<Eigen::Index>(shared));
  summary.objects.reserve(objects);
  for (std::size_t i = 0; i < objects; ++i) summary.objects.push_back(take_object(i, summary, reader));
  for (std::uint32_t i = 0; i < apart; ++i) {
    const auto first = reader.take<std::uint32_t>();
    summary.apart.emplace_back(first, reader.take<std::uint32_t>());
  }
  if (version != kPlainVersion) summary.part = take_part(name, reader);
  refuse_problems(name, summary);
  return summary;
}

}  // namespace geoloc::io
