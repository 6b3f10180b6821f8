// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/object_report.hpp"

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <utility>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/projection/ground_model.hpp"
#include "geoloc/projection/projector.hpp"
#include "geoloc/state/state_provider.hpp"

namespace geoloc::io {
namespace {

/// Whether the report tells where the track is now.
bool tells(const ObjectReport& report, const Track& track) {
  return report.position_in_enu == track.position_in_enu.mean &&
         report.covariance_in_enu == track.position_in_enu.covariance;
}

/// What takes time to tell.
ObjectReport place_of(const Track& track, const LocalFrame& frame) {
  ObjectReport report;
  report.id = track.id;
  report.position_in_enu = track.position_in_enu.mean;
  report.position = frame.to_geodetic(report.position_in_enu);
  report.covariance_in_enu = track.position_in_enu.covariance;
  report.ellipse = error_ellipse(track.position_in_enu.covariance);
  return report;
}

/// All else.
void describe(const Track& track, const Geolocator& geolocator, const std::vector<std::string>& class_names,
              ObjectReport& report) {
  const int class_id = track.class_id();
  if (report.class_name.empty() || class_id != report.class_id)
    report.class_name = class_name_of(class_id, class_names);
  report.class_id = class_id;
  report.confidence = track.confidence();
  report.hits = track.hits;
  report.first_seen = track.first_seen;
  report.last_seen = track.last_seen;
  report.height = height_of(track, geolocator);
  if (track.velocity_in_enu) report.course = course_of(track.velocity_in_enu->mean);
}

}  // namespace

ErrorEllipse error_ellipse(const Eigen::Matrix2d& covariance) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes;
  axes.computeDirect(covariance);
  const Eigen::Vector2d major = axes.eigenvectors().col(1);
  double azimuth_deg = std::atan2(major.x(), major.y()) * kDegPerRad;
  if (azimuth_deg < 0.0) azimuth_deg += 180.0;
  if (azimuth_deg >= 180.0) azimuth_deg -= 180.0;
  return {std::sqrt(std::max(0.0, axes.eigenvalues()[1])), std::sqrt(std::max(0.0, axes.eigenvalues()[0])),
          azimuth_deg};
}

Course course_of(const Eigen::Vector2d& velocity_in_enu) {
  const double direction_deg = std::atan2(velocity_in_enu.x(), velocity_in_enu.y()) * kDegPerRad;
  return {velocity_in_enu.norm(), direction_deg < 0.0 ? direction_deg + 360.0 : direction_deg};
}

HeightReport height_of(const Track& track, const Geolocator& geolocator) {
  HeightReport height;
  height.above_home_m = track.height ? track.height->above_home_m
                                     : geolocator.projector().config().ground_height_above_home_m +
                                           geolocator.ground().height_m(track.position_in_enu.mean);
  if (track.height) height.sigma_m = track.height->sigma_m;
  if (const auto home_msl_m = geolocator.state().home_height_msl_m())
    height.msl_m = *home_msl_m + height.above_home_m;
  return height;
}

std::vector<ObjectReport> report_objects(const Geolocator& geolocator,
                                         const std::vector<std::string>& class_names, TrackStatus status) {
  std::vector<ObjectReport> reports;
  update_reports(geolocator, class_names, status, reports);
  return reports;
}

/// Both lists are in order of their ids.
void update_reports(const Geolocator& geolocator, const std::vector<std::string>& class_names,
                    TrackStatus status, std::vector<ObjectReport>& reports) {
  std::vector<ObjectReport> updated;
  updated.reserve(reports.size());
  auto before = reports.begin();
  for (const Track& track : geolocator.tracks()) {
    if (track.status != status) continue;
    while (before != reports.end() && before->id < track.id) ++before;
    const bool is_known = before != reports.end() && before->id == track.id;
    if (is_known && tells(*before, track)) {
      updated.push_back(std::move(*before));
    } else {
      updated.push_back(place_of(track, *geolocator.local_frame()));
    }
    describe(track, geolocator, class_names, updated.back());
  }
  reports = std::move(updated);
}

std::string class_name_of(int class_id, const std::vector<std::string>& class_names) {
  const auto name = static_cast<std::size_t>(class_id);
  return name < class_names.size() ? class_names[name] : "class " + std::to_string(class_id);
}

bool has_place(const ObjectReport& object) {
  return is_valid(object.position) && object.position_in_enu.allFinite();
}

std::string iso8601(HostTime time) {
  const auto since_epoch = std::chrono::floor<std::chrono::milliseconds>(time.time_since_epoch());
  const auto whole_seconds = std::chrono::floor<std::chrono::seconds>(since_epoch);
  const auto seconds_since_epoch = static_cast<std::time_t>(whole_seconds.count());
  std::tm utc{};
  gmtime_r(&seconds_since_epoch, &utc);
  std::array<char, 32> date{};
  std::strftime(date.data(), date.size(), "%Y-%m-%dT%H:%M:%S", &utc);
  std::array<char, 8> milliseconds{};
  std::snprintf(milliseconds.data(), milliseconds.size(), ".%03dZ",
                static_cast<int>((since_epoch - whole_seconds).count()));
  return std::string(date.data()) + milliseconds.data();
}

}  // namespace geoloc::io
