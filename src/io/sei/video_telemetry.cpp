// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/sei/video_telemetry.hpp"

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

namespace geoloc::io {
namespace {

using nlohmann::json;

constexpr const char* kSchema = "apcg.telemetry.v1";
constexpr double kLargestTurn_rad = 6.2832;  // for angles that may be given as 0..2 pi
constexpr double kLargestPitch_rad = 1.5709;
constexpr double kLargestHeight_m = 100e3;
constexpr double kFastest_mps = 320.0;  // what GLOBAL_POSITION_INT, of which it is, can tell
constexpr double kOldest_ms = 10'000.0;
constexpr double kLargestZoom = 1000.0;
constexpr std::int64_t kLatest_us = 7'258'118'400'000'000;  // the year 2200

/// A number of a group by its name; NaN, which no range contains, where it is none.
double number(const json& group, const char* name) {
  const auto found = group.find(name);
  return found != group.end() && found->is_number() ? found->get<double>() : std::nan("");
}

/// False for NaN.
bool is_within(double value, double limit) {
  return std::abs(value) <= limit;
}

std::optional<Duration> age_of(const json& group) {
  const double age_ms = number(group, "age_ms");
  if (!(age_ms >= 0.0 && age_ms <= kOldest_ms)) return std::nullopt;
  return from_seconds(1e-3 * age_ms);
}

std::optional<VideoTelemetry::Position> position_in(const json& group) {
  constexpr double kUnitsPerDegree = 1e7;
  VideoTelemetry::Position told;
  told.position = {number(group, "lat_e7") / kUnitsPerDegree, number(group, "lon_e7") / kUnitsPerDegree};
  told.height_msl_m = number(group, "alt_amsl_m");
  told.height_above_home_m = number(group, "alt_relative_m");
  const auto age = age_of(group);
  const bool is_valid =
      age && is_within(told.position.latitude_deg, 90.0) && is_within(told.position.longitude_deg, 180.0) &&
      is_within(told.height_msl_m, kLargestHeight_m) && is_within(told.height_above_home_m, kLargestHeight_m);
  if (!is_valid) return std::nullopt;
  told.age = *age;
  return told;
}

std::optional<VideoTelemetry::Velocity> velocity_in(const json& group) {
  const Eigen::Vector3d enu(number(group, "ve_m_s"), number(group, "vn_m_s"), -number(group, "vd_m_s"));
  const auto age = age_of(group);
  if (!age || !is_within(enu.x(), kFastest_mps) || !is_within(enu.y(), kFastest_mps) ||
      !is_within(enu.z(), kFastest_mps))
    return std::nullopt;
  return VideoTelemetry::Velocity{enu, *age};
}

std::optional<VideoTelemetry::Attitude> attitude_in(const json& group, double largest_pitch_rad) {
  const EulerAngles angles{number(group, "roll_rad"), number(group, "pitch_rad"), number(group, "yaw_rad")};
  const auto age = age_of(group);
  if (!age || !is_within(angles.roll_rad, kLargestTurn_rad) ||
      !is_within(angles.pitch_rad, largest_pitch_rad) || !is_within(angles.yaw_rad, kLargestTurn_rad))
    return std::nullopt;
  return VideoTelemetry::Attitude{angles, *age};
}

std::optional<VideoTelemetry::Attitude> vehicle_in(const json& group) {
  return attitude_in(group, kLargestPitch_rad);
}

/// Gimbals turn beyond the nadir.
std::optional<VideoTelemetry::Attitude> gimbal_in(const json& group) {
  return attitude_in(group, kLargestTurn_rad);
}

/// A number between 0 and a limit, both excluded.
std::optional<double> positive(const json& value, double limit) {
  const double number = value.is_number() ? value.get<double>() : 0.0;
  if (!(number > 0.0 && number < limit)) return std::nullopt;
  return number;
}

/// Reads what stands under the name, unless that is null or nothing.
template <typename Value, typename Read>
void take(const json& record, const char* name, const Read& read, VideoTelemetry& telemetry,
          std::optional<Value>& value) {
  const auto found = record.find(name);
  if (found == record.end() || found->is_null()) return;
  value = read(*found);
  if (!value) ++telemetry.refused_values;
}

template <typename Group, typename Read>
void take_group(const json& record, const char* name, const Read& read, VideoTelemetry& telemetry,
                std::optional<Group>& group) {
  const auto read_object = [&read](const json& found) {
    return found.is_object() ? read(found) : std::optional<Group>{};
  };
  take(record, name, read_object, telemetry, group);
}

/// nullopt unless it is a whole number of microseconds that a clock can show.
std::optional<CameraTime> time_in(const json& record) {
  const auto found = record.find("utc_us");
  if (found == record.end() || !found->is_number_integer()) return std::nullopt;
  const auto utc_us = found->get<std::int64_t>();
  if (utc_us < 0 || utc_us > kLatest_us) return std::nullopt;
  return CameraTime{std::chrono::microseconds{utc_us}};
}

bool is_of_schema(const json& record) {
  if (!record.is_object()) return false;
  const auto schema = record.find("schema");
  return schema != record.end() && schema->is_string() && *schema == kSchema;
}

std::int64_t milliseconds(Duration age) {
  return std::chrono::floor<std::chrono::milliseconds>(age).count();
}

nlohmann::ordered_json attitude_to_json(const std::optional<VideoTelemetry::Attitude>& told) {
  if (!told) return nullptr;
  return {{"roll_rad", told->angles.roll_rad},
          {"pitch_rad", told->angles.pitch_rad},
          {"yaw_rad", told->angles.yaw_rad},
          {"age_ms", milliseconds(told->age)}};
}

}  // namespace

std::optional<VideoTelemetry> parse_video_telemetry(std::string_view text) {
  if (text.size() > kLongestTelemetry) return std::nullopt;
  while (!text.empty() && text.back() == '\0') text.remove_suffix(1);
  const json record = json::parse(text, nullptr, false);
  if (record.is_discarded() || !is_of_schema(record)) return std::nullopt;
  const auto made_at = time_in(record);
  if (!made_at) return std::nullopt;
  VideoTelemetry telemetry;
  telemetry.made_at = *made_at;
  take_group(record, "position", position_in, telemetry, telemetry.position);
  take_group(record, "velocity", velocity_in, telemetry, telemetry.velocity);
  take_group(record, "vehicle_attitude", vehicle_in, telemetry, telemetry.vehicle);
  take_group(record, "gimbal_attitude", gimbal_in, telemetry, telemetry.gimbal);
  const auto read_zoom = [](const json& value) { return positive(value, kLargestZoom); };
  const auto read_fov = [](const json& value) { return positive(value, 180.0); };
  take(record, "zoom", read_zoom, telemetry, telemetry.zoom);
  take(record, "hfov_deg", read_fov, telemetry, telemetry.horizontal_fov_deg);
  return telemetry;
}

std::string to_json(const VideoTelemetry& telemetry) {
  constexpr double kUnitsPerDegree = 1e7;
  const auto utc = std::chrono::floor<std::chrono::microseconds>(telemetry.made_at.time_since_epoch());
  nlohmann::ordered_json record{{"schema", kSchema}, {"utc_us", utc.count()}};
  record["position"] = nullptr;
  if (const auto& told = telemetry.position)
    record["position"] = {{"lat_e7", std::llround(told->position.latitude_deg * kUnitsPerDegree)},
                          {"lon_e7", std::llround(told->position.longitude_deg * kUnitsPerDegree)},
                          {"alt_amsl_m", told->height_msl_m},
                          {"alt_relative_m", told->height_above_home_m},
                          {"age_ms", milliseconds(told->age)}};
  record["velocity"] = nullptr;
  if (const auto& told = telemetry.velocity)
    record["velocity"] = {{"vn_m_s", told->velocity_in_enu.y()},
                          {"ve_m_s", told->velocity_in_enu.x()},
                          {"vd_m_s", -told->velocity_in_enu.z()},
                          {"age_ms", milliseconds(told->age)}};
  record["vehicle_attitude"] = attitude_to_json(telemetry.vehicle);
  record["gimbal_attitude"] = attitude_to_json(telemetry.gimbal);
  record["zoom"] = nullptr;
  if (telemetry.zoom) record["zoom"] = *telemetry.zoom;
  record["hfov_deg"] = nullptr;
  if (telemetry.horizontal_fov_deg) record["hfov_deg"] = *telemetry.horizontal_fov_deg;
  return record.dump();
}

}  // namespace geoloc::io
