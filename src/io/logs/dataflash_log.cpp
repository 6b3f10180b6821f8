// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <cmath>
#include <utility>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/io/logs/log_formats.hpp"
#include "io/logs/dataflash.hpp"
#include "io/logs/log_builder.hpp"

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;

/// GPS time is ahead of UTC by this since 2017; logs of earlier years are a second or two off, which only
/// shows in the times of the results.
constexpr Duration kLeapSeconds = 18s;
constexpr Duration kGpsEpoch = 315'964'800s;  // 6 January 1980, since 1970
constexpr double kFix3d = 3.0;
constexpr double kHome = 1.0;  // of ORGN's types

/// The first of the names that the record has and that is a number.
std::optional<double> first_of(const DataflashRecord& record, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    const auto value = record.number(name);
    if (value && std::isfinite(*value)) return value;
  }
  return std::nullopt;
}

/// Logs before 3.3 count milliseconds.
std::optional<VehicleTime> time_of(const DataflashRecord& record) {
  auto time_us = record.number("TimeUS");
  if (!time_us) {
    const auto time_ms = record.number("TimeMS");
    if (time_ms) time_us = 1e3 * *time_ms;
  }
  if (!time_us || !is_time_us(*time_us)) return std::nullopt;
  return time_from_us(*time_us);
}

std::optional<EulerAngles> angles_of(const DataflashRecord& record, const char* yaw_name) {
  const auto roll_deg = first_of(record, {"Roll"}), pitch_deg = first_of(record, {"Pitch"}),
             yaw_deg = first_of(record, {yaw_name});
  if (!roll_deg || !pitch_deg || !yaw_deg) return std::nullopt;
  return EulerAngles{*roll_deg * kRadPerDeg, *pitch_deg * kRadPerDeg, wrap_to_pi(*yaw_deg * kRadPerDeg)};
}

std::optional<Geodetic> place_of(const DataflashRecord& record) {
  const auto latitude_deg = first_of(record, {"Lat"}), longitude_deg = first_of(record, {"Lng"});
  if (!latitude_deg || !longitude_deg) return std::nullopt;
  const Geodetic place{*latitude_deg, *longitude_deg};
  return is_place(place) ? std::optional(place) : std::nullopt;
}

/// Of several receivers, gimbals or filters, the first: `I` or `C` number them in newer logs.
bool is_first_instance(const DataflashRecord& record) {
  return first_of(record, {"I", "C"}).value_or(0.0) == 0.0;
}

/// Takes the records one by one. Where the best kind of record is missing, another tells the same.
class DataflashCollector {
 public:
  void take(const DataflashRecord& record) {
    const auto time = time_of(record);
    if (!time) return;
    const std::string& name = record.name();
    if (name == "ATT") {
      take_attitude(record, *time, log_.attitudes);
    } else if (name == "AHR2") {
      take_attitude(record, *time, second_attitudes_);
      take_position(record, *time, second_positions_);
    } else if (name == "POS") {
      take_position(record, *time, log_.positions);
    } else if (name == "GPS") {
      take_fix(record, *time);
    } else if (name == "GPA") {
      take_accuracy(record);
    } else if (name == "XKF1" || name == "NKF1" || name == "EKF1") {
      take_velocity(record, *time);
    } else {
      take_rare(record, *time);
    }
  }

  FlightLog finished(std::size_t skipped_bytes) {
    if (log_.attitudes.empty()) log_.attitudes = std::move(second_attitudes_);
    if (log_.positions.empty() && !second_positions_.empty()) {
      log_.positions = std::move(second_positions_);
      log_.assumptions.emplace_back("the log has no POS: positions are those of AHR2");
    }
    log_.skipped_bytes = skipped_bytes;
    finish(log_);
    return std::move(log_);
  }

 private:
  static void take_attitude(const DataflashRecord& record, VehicleTime time,
                            std::vector<AttitudeSample>& attitudes) {
    if (const auto angles = angles_of(record, "Yaw")) keep(attitudes, {time, *angles});
  }

  static void take_position(const DataflashRecord& record, VehicleTime time,
                            std::vector<LoggedPosition>& positions) {
    const auto place = place_of(record);
    if (!place) return;
    keep(positions, {time,
                     *place,
                     {first_of(record, {"RelHomeAlt", "RelAlt"}), first_of(record, {"Alt"}), std::nullopt}});
  }

  void take_fix(const DataflashRecord& record, VehicleTime time) {
    if (!is_first_instance(record)) return;
    LoggedFix fix;
    fix.time = time;
    fix.position = place_of(record).value_or(Geodetic{});
    fix.height_msl_m = first_of(record, {"Alt"});
    fix.fix_type = static_cast<int>(std::clamp(first_of(record, {"Status"}).value_or(0.0), 0.0, 8.0));
    take_utc(record, time, fix.fix_type);
    keep(log_.fixes, fix);
  }

  void take_utc(const DataflashRecord& record, VehicleTime time, int fix_type) {
    constexpr double kMostWeek = 10'000.0, kWeek_ms = 604.8e6;
    const auto week = first_of(record, {"GWk", "Week"}), within_ms = first_of(record, {"GMS", "TimeMS"});
    if (!week || !within_ms || fix_type < kFix3d) return;
    if (!(*week > 0.0 && *week < kMostWeek && *within_ms >= 0.0 && *within_ms < kWeek_ms)) return;
    const Duration since_epoch =
        std::chrono::hours{168} * std::llround(*week) + std::chrono::milliseconds{std::llround(*within_ms)};
    keep(log_.utc, {time, HostTime{kGpsEpoch + since_epoch - kLeapSeconds}});
  }

  /// It follows the GPS record of the same fix.
  void take_accuracy(const DataflashRecord& record) {
    if (!is_first_instance(record) || log_.fixes.empty()) return;
    const auto sigma_of = [&](const char* field) -> std::optional<double> {
      const auto sigma_m = first_of(record, {field});
      return sigma_m && *sigma_m > 0.0 ? sigma_m : std::nullopt;
    };
    log_.fixes.back().sigma_horizontal_m = sigma_of("HAcc");
    log_.fixes.back().sigma_height_m = sigma_of("VAcc");
  }

  void take_velocity(const DataflashRecord& record, VehicleTime time) {
    const auto north = first_of(record, {"VN"}), east = first_of(record, {"VE"}),
               down = first_of(record, {"VD"});
    if (is_first_instance(record) && north && east && down)
      keep(log_.velocities, {time, Eigen::Vector3d(*east, *north, -*down)});
  }

  void take_rare(const DataflashRecord& record, VehicleTime time) {
    const std::string& name = record.name();
    if (name == "ORGN" && first_of(record, {"Type"}) == kHome && !log_.home_height_msl_m) {
      log_.home_height_msl_m = first_of(record, {"Alt"});
    } else if (name == "CAM" || (name == "TRIG" && !has_feedback_)) {
      // A camera with feedback has each picture in both; what was triggered before the first one counts less.
      if (name == "CAM" && !std::exchange(has_feedback_, true)) drop_exposures(log_);
      keep(log_.camera_events, {time, CameraEventKind::kExposure});
    } else if (name == "MAVC" && first_of(record, {"Cmd"}) == kVideoStartCommand) {
      keep(log_.camera_events, {time, CameraEventKind::kVideoStart});
    } else if (name == "MNT" && is_first_instance(record)) {
      take_gimbal(record, time);
    }
  }

  void take_gimbal(const DataflashRecord& record, VehicleTime time) {
    if (const auto angles = angles_of(record, "YawE")) {
      keep(log_.gimbal, {time, *angles, GimbalYaw::kFromNorth});
    } else if (const auto nose_angles = angles_of(record, "YawB")) {
      keep(log_.gimbal, {time, *nose_angles, GimbalYaw::kFromNose});
    }
  }

  FlightLog log_;
  std::vector<AttitudeSample> second_attitudes_;
  std::vector<LoggedPosition> second_positions_;
  bool has_feedback_ = false;
};

}  // namespace

FlightLog parse_dataflash(std::string_view bytes) {
  DataflashCollector collector;
  const std::size_t skipped =
      for_each_dataflash_record(bytes, [&](const DataflashRecord& record) { collector.take(record); });
  return collector.finished(skipped);
}

}  // namespace geoloc::io
