// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "geoloc/io/fleet/summary_file.hpp"
#include "json_members.hpp"
#include "part_json.hpp"
#include "summary_checks.hpp"

namespace geoloc::io {
namespace {

constexpr const char* kFormat = "geoloc flight summary";

ordered_json object_to_json(const FlightSummary& summary, std::size_t i) {
  const FlightSummary::Object& object = summary.objects[i];
  auto votes = ordered_json::array(), covariance = ordered_json::array(), shared = ordered_json::array();
  for (const ClassVotes::Vote& vote : object.class_votes.votes())
    votes.push_back({vote.class_id, vote.weight});
  for (int row = 0; row < 3; ++row) {
    covariance.push_back(row_to_json(object.own_covariance.row(row)));
    shared.push_back(row_to_json(summary.shared_error_of(i).row(row)));
  }
  return {{"id", object.id},
          {"hits", object.hits},
          {"existence", object.existence},
          {"first_seen_ns", object.first_seen.time_since_epoch().count()},
          {"last_seen_ns", object.last_seen.time_since_epoch().count()},
          {"class_votes", votes},
          {"position_in_enu_m", row_to_json(object.position_in_enu.transpose())},
          {"own_covariance_m2", covariance},
          {"shared_error_m", shared}};
}

template <typename Matrix>
void read_rows(const json& rows, const char* what, Matrix&& matrix) {
  list(rows, static_cast<std::size_t>(matrix.rows()), what);
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    const json& numbers =
        list(rows[static_cast<std::size_t>(row)], static_cast<std::size_t>(matrix.cols()), what);
    for (Eigen::Index column = 0; column < matrix.cols(); ++column)
      matrix(row, column) = number(numbers[static_cast<std::size_t>(column)], what);
  }
}

ClassVotes read_votes(const json& list_of_votes) {
  ClassVotes::Votes votes{};
  if (!list_of_votes.is_array() || list_of_votes.size() > votes.size())
    throw std::runtime_error("class_votes must be a list of at most four");
  for (std::size_t i = 0; i < list_of_votes.size(); ++i) {
    const json& vote = list(list_of_votes[i], 2, "a vote");
    votes[i] = {whole<std::int32_t>(vote[0], "a vote's class"), number(vote[1], "a vote's weight")};
  }
  return ClassVotes(votes);
}

FlightSummary::Object read_object(const json& value, std::size_t i, FlightSummary& summary) {
  FlightSummary::Object object;
  object.id = whole<std::uint64_t>(member(value, "id"), "id");
  object.hits = whole<std::int32_t>(member(value, "hits"), "hits");
  object.existence = number(member(value, "existence"), "existence");
  object.first_seen = time<HostTime>(value, "first_seen_ns");
  object.last_seen = time<HostTime>(value, "last_seen_ns");
  object.class_votes = read_votes(member(value, "class_votes"));
  const json& position = list(member(value, "position_in_enu_m"), 3, "position_in_enu_m");
  for (std::size_t row = 0; row < 3; ++row)
    object.position_in_enu[static_cast<Eigen::Index>(row)] = number(position[row], "position_in_enu_m");
  read_rows(member(value, "own_covariance_m2"), "own_covariance_m2", object.own_covariance);
  read_rows(member(value, "shared_error_m"), "shared_error_m",
            summary.shared_error.middleRows<3>(3 * static_cast<Eigen::Index>(i)));
  return object;
}

/// As many as the first object has, and all others, so that no more room is made than the text fills.
std::size_t shared_count(const json& objects) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const json& rows = list(member(objects[i], "shared_error_m"), 3, "shared_error_m");
    if (i == 0) count = rows[0].size();
    for (const json& row : rows) list(row, count, "a row of shared_error_m");
  }
  return count;
}

FlightSummary read_document(const json& document, const std::string& name) {
  if (text(member(document, "format"), "format") != kFormat)
    throw std::runtime_error(std::string("format must be \"") + kFormat + "\"");
  const auto version = whole<std::uint64_t>(member(document, "version"), "version");
  refuse_other_version(name, version);
  const json& objects = member(document, "objects");
  const json& apart = member(document, "apart");
  if (!objects.is_array() || !apart.is_array()) throw std::runtime_error("objects and apart must be lists");
  const std::size_t shared = shared_count(objects);
  refuse_absurd_sizes(name, objects.size(), shared, apart.size());

  FlightSummary summary;
  summary.identity = {text(member(document, "flight"), "flight"),
                      text(member(document, "vehicle"), "vehicle"),
                      whole<std::uint64_t>(member(document, "sequence"), "sequence")};
  const json& origin = member(document, "origin");
  summary.origin = {number(member(origin, "latitude_deg"), "latitude_deg"),
                    number(member(origin, "longitude_deg"), "longitude_deg")};
  if (const json& home = member(document, "home_height_msl_m"); !home.is_null())
    summary.home_height_msl_m = number(home, "home_height_msl_m");
  summary.shared_error.resize(3 * static_cast<Eigen::Index>(objects.size()),
                              static_cast<Eigen::Index>(shared));
  for (std::size_t i = 0; i < objects.size(); ++i) {
    try {
      summary.objects.push_back(read_object(objects[i], i, summary));
    } catch (const std::runtime_error& error) {
      throw std::runtime_error("objects[" + std::to_string(i) + "]: " + error.what());
    }
  }
  for (const json& pair : apart) {
    const json& places = list(pair, 2, "a pair apart");
    summary.apart.emplace_back(whole<std::uint32_t>(places[0], "a place"),
                               whole<std::uint32_t>(places[1], "a place"));
  }
  if (version != kPlainVersion) summary.part = part_from_json(name, member(document, "part"));
  return summary;
}

}  // namespace

std::string summary_to_json(const FlightSummary& summary) {
  auto objects = ordered_json::array(), apart = ordered_json::array();
  for (std::size_t i = 0; i < summary.objects.size(); ++i) objects.push_back(object_to_json(summary, i));
  for (const auto& [first, second] : summary.apart) apart.push_back({first, second});
  const ordered_json home =
      summary.home_height_msl_m ? ordered_json(*summary.home_height_msl_m) : ordered_json();
  ordered_json document{
      {"format", kFormat},
      {"version", version_of(summary)},
      {"flight", summary.identity.flight},
      {"vehicle", summary.identity.vehicle},
      {"sequence", summary.identity.sequence},
      {"origin",
       {{"latitude_deg", summary.origin.latitude_deg}, {"longitude_deg", summary.origin.longitude_deg}}},
      {"home_height_msl_m", home},
      {"objects", objects},
      {"apart", apart}};
  if (summary.part) document["part"] = part_to_json(*summary.part);
  return document.dump(1) + "\n";
}

FlightSummary summary_from_json(std::string_view content, const std::string& name) {
  const json document = json::parse(content, nullptr, false);
  if (document.is_discarded()) refuse_summary(name, "is not JSON, or was cut off");
  FlightSummary summary;
  try {
    summary = read_document(document, name);
  } catch (const std::runtime_error& error) {
    const std::string reason = error.what();
    if (reason.rfind(name + ": ", 0) == 0) throw;
    refuse_summary(name, reason);
  }
  refuse_problems(name, summary);
  return summary;
}

}  // namespace geoloc::io
