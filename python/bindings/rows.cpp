// SPDX-License-Identifier: Apache-2.0
#include "rows.hpp"

#include <algorithm>
#include <cmath>

#include "geoloc/io/output/object_report.hpp"

namespace geoloc::python {
namespace {

/// Row by row.
template <int size>
void copy(const Eigen::Matrix<double, size, size>& matrix, double (&values)[size * size]) {
  for (int i = 0; i < size * size; ++i) values[i] = matrix(i / size, i % size);
}

template <typename Row>
void place(const Eigen::Vector2d& position_in_enu, const LocalFrame& frame, Row& row) {
  const Geodetic where = frame.to_geodetic(position_in_enu);
  row.latitude_deg = where.latitude_deg;
  row.longitude_deg = where.longitude_deg;
  row.position_in_enu_m[0] = position_in_enu.x();
  row.position_in_enu_m[1] = position_in_enu.y();
}

template <typename Row>
void describe(const Detection& detection, Row& row) {
  const Box& box = detection.box;
  const double edges[4] = {box.x, box.y, box.width, box.height};
  std::copy_n(edges, 4, row.box_px);
  row.confidence = detection.confidence;
  row.class_id = detection.class_id;
}

template <typename Row>
void describe(const io::ErrorEllipse& ellipse, Row& row) {
  row.sigma_major_m = ellipse.sigma_major_m;
  row.sigma_minor_m = ellipse.sigma_minor_m;
  row.sigma_azimuth_deg = ellipse.azimuth_deg;
}

std::int64_t ns(HostTime time) {
  return time.time_since_epoch().count();
}

/// What an object of one flight and one of the map have in common.
template <typename Object, typename Row>
void describe_seen(const Object& object, Row& row) {
  row.id = object.id;
  row.class_id = object.class_votes.winner();
  row.hits = object.hits;
  row.confidence = object.existence;
  std::copy_n(object.position_in_enu.data(), 3, row.position_in_enu_m);
  row.first_seen_ns = ns(object.first_seen);
  row.last_seen_ns = ns(object.last_seen);
}

}  // namespace

ObjectRow row_of(const Track& track, const LocalFrame& frame) {
  ObjectRow row{};
  row.id = track.id;
  row.class_id = track.class_id();
  row.hits = track.hits;
  row.confidence = track.confidence();
  place(track.position_in_enu.mean, frame, row);
  copy(track.position_in_enu.covariance, row.covariance_m2);
  describe(io::error_ellipse(track.position_in_enu.covariance), row);
  row.height_above_home_m = track.height ? track.height->above_home_m : NAN;
  row.sigma_height_m = track.height ? track.height->sigma_m : NAN;
  const Eigen::Vector2d unknown = Eigen::Vector2d::Constant(NAN);
  const Eigen::Vector2d velocity = track.velocity_in_enu ? track.velocity_in_enu->mean : unknown;
  std::copy_n(velocity.data(), 2, row.velocity_in_enu_mps);
  copy<2>(track.velocity_in_enu ? track.velocity_in_enu->covariance : Eigen::Matrix2d::Constant(NAN).eval(),
          row.velocity_covariance_m2ps2);
  row.first_seen_ns = ns(track.first_seen);
  row.last_seen_ns = ns(track.last_seen);
  row.is_confirmed = track.status == TrackStatus::kConfirmed;
  return row;
}

FixRow row_of(const LocatedDetection& located, const LocalFrame& frame) {
  FixRow row{};
  describe(located.detection, row);
  place(located.fix.position_in_enu, frame, row);
  copy(located.fix.ground_from_pixel, row.ground_from_pixel_mppx);
  row.range_m = located.fix.range_m;
  return row;
}

SummaryObjectRow row_of(const FlightSummary::Object& object) {
  SummaryObjectRow row{};
  describe_seen(object, row);
  copy(object.own_covariance, row.own_covariance_m2);
  return row;
}

FusedObjectRow row_of(const FusedObject& object, const LocalFrame& frame) {
  FusedObjectRow row{};
  describe_seen(object, row);
  const Geodetic where = frame.to_geodetic(object.position_in_enu.head<2>());
  row.latitude_deg = where.latitude_deg;
  row.longitude_deg = where.longitude_deg;
  row.height_above_home_m = object.position_in_enu.z();
  describe(io::error_ellipse(object.covariance.topLeftCorner<2, 2>()), row);
  row.sigma_height_m = std::sqrt(object.covariance(2, 2));
  copy(object.covariance, row.covariance_m2);
  return row;
}

RawFixRow row_of(const io::RawFix& fix, const LocalFrame& frame) {
  RawFixRow row{};
  row.captured_at_ns = ns(fix.captured_at);
  row.frame = fix.frame;
  row.object_id = fix.look.object_id ? static_cast<std::int64_t>(*fix.look.object_id) : -1;
  describe(fix.detection, row);
  place(fix.position_in_enu, frame, row);
  row.range_m = fix.range_m;
  const Eigen::Vector2d expected_px = fix.look.expected_px.value_or(Eigen::Vector2d::Constant(NAN));
  std::copy_n(expected_px.data(), 2, row.expected_px);
  return row;
}

TrajectoryRow row_of(const io::TrajectoryPoint& point, const LocalFrame& frame) {
  TrajectoryRow row{};
  row.captured_at_ns = ns(point.at);
  const Geodetic where = frame.to_geodetic(point.position_in_enu.head<2>());
  row.latitude_deg = where.latitude_deg;
  row.longitude_deg = where.longitude_deg;
  std::copy_n(point.position_in_enu.data(), 3, row.position_in_enu_m);
  return row;
}

}  // namespace geoloc::python
