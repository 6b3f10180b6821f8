// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/kml.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/io/output/markup.hpp"

namespace geoloc::io {
namespace {

constexpr int kEllipseCorners = 36;

// Colours are alpha, blue, green, red.
constexpr const char* kHead = R"(<?xml version="1.0" encoding="UTF-8"?>
<kml xmlns="http://www.opengis.net/kml/2.2" xmlns:gx="http://www.google.com/kml/ext/2.2">
<Document>
<name>{}</name>
<description>{}</description>
<Style id="object"><IconStyle><color>ff4aa316</color><scale>0.8</scale><Icon><href>http://maps.google.com/mapfiles/kml/shapes/placemark_circle.png</href></Icon></IconStyle><LabelStyle><scale>0.7</scale></LabelStyle></Style>
<Style id="ellipse"><LineStyle><color>ff4aa316</color><width>1.5</width></LineStyle><PolyStyle><color>334aa316</color></PolyStyle></Style>
<Style id="trajectory"><IconStyle><Icon><href>http://maps.google.com/mapfiles/kml/shapes/track.png</href></Icon></IconStyle><LineStyle><color>ffb8a394</color><width>2</width></LineStyle></Style>
)";

void write_data(const char* name, const std::string& value, std::string& kml) {
  fmt::format_to(std::back_inserter(kml), "<Data name=\"{}\"><value>{}</value></Data>", name, value);
}

void write_number(const char* name, double value, int digits, std::string& kml) {
  if (std::isfinite(value)) write_data(name, fmt::format("{:.{}f}", value, digits), kml);
}

void write_properties(const ObjectReport& object, std::string& kml) {
  kml += "<ExtendedData>";
  write_data("id", std::to_string(object.id), kml);
  write_data("class_id", std::to_string(object.class_id), kml);
  write_data("class_name", escape_markup(object.class_name), kml);
  write_number("confidence", object.confidence, 3, kml);
  write_data("hits", std::to_string(object.hits), kml);
  write_data("first_seen", iso8601(object.first_seen), kml);
  write_data("last_seen", iso8601(object.last_seen), kml);
  write_number("sigma_major_m", object.ellipse.sigma_major_m, 4, kml);
  write_number("sigma_minor_m", object.ellipse.sigma_minor_m, 4, kml);
  write_number("sigma_azimuth_deg", object.ellipse.azimuth_deg, 1, kml);
  write_number("height_above_home_m", object.height.above_home_m, 3, kml);
  if (object.height.sigma_m) write_number("sigma_height_m", *object.height.sigma_m, 4, kml);
  if (object.height.msl_m) write_number("height_msl_m", *object.height.msl_m, 3, kml);
  if (object.height.ellipsoid_m) write_number("height_ellipsoid_m", *object.height.ellipsoid_m, 3, kml);
  if (object.course) {
    write_number("speed_mps", object.course->speed_mps, 2, kml);
    write_number("course_deg", object.course->direction_deg, 1, kml);
  }
  if (!object.note.name.empty()) write_data("operator_name", escape_markup(object.note.name), kml);
  if (object.note.verdict != Verdict::kNone)
    write_data("operator_verdict", word_of(object.note.verdict), kml);
  kml += "</ExtendedData>\n";
}

/// The ellipse as an outer ring of KML: counter-clockwise, with the first corner repeated at the end.
std::string ellipse_ring(const ObjectReport& object, const LocalFrame& frame) {
  const double azimuth_rad = object.ellipse.azimuth_deg * kRadPerDeg;
  const Eigen::Vector2d major(std::sin(azimuth_rad), std::cos(azimuth_rad));
  const Eigen::Vector2d minor(-major.y(), major.x());
  std::string ring;
  for (int i = 0; i <= kEllipseCorners; ++i) {
    const double angle_rad = 2.0 * kPi * (i % kEllipseCorners) / kEllipseCorners;
    const Eigen::Vector2d offset_m =
        kDrawnSigmas * (object.ellipse.sigma_major_m * std::cos(angle_rad) * major +
                        object.ellipse.sigma_minor_m * std::sin(angle_rad) * minor);
    const Geodetic corner = frame.to_geodetic(object.position_in_enu + offset_m);
    fmt::format_to(std::back_inserter(ring), "{:.9f},{:.9f} ", corner.longitude_deg, corner.latitude_deg);
  }
  return ring;
}

void write_object(const ObjectReport& object, const LocalFrame& frame, std::string& kml) {
  const auto out = std::back_inserter(kml);
  const std::string& called = object.note.name.empty() ? object.class_name : object.note.name;
  const std::string name = escape_markup(called) + " " + std::to_string(object.id);
  const std::string since = "<TimeSpan><begin>" + iso8601(object.first_seen) + "</begin></TimeSpan>";
  fmt::format_to(out, "<Placemark><name>{}</name>{}<styleUrl>#object</styleUrl>\n", name, since);
  write_properties(object, kml);
  fmt::format_to(out, "<Point><coordinates>{:.9f},{:.9f}</coordinates></Point></Placemark>\n",
                 object.position.longitude_deg, object.position.latitude_deg);
  if (!std::isfinite(object.ellipse.sigma_major_m + object.ellipse.sigma_minor_m +
                     object.ellipse.azimuth_deg))
    return;
  fmt::format_to(out,
                 "<Placemark><name>{}: 2 sigma</name>{}<styleUrl>#ellipse</styleUrl><Polygon>"
                 "<outerBoundaryIs><LinearRing><coordinates>{}</coordinates></LinearRing></outerBoundaryIs>"
                 "</Polygon></Placemark>\n",
                 name, since, ellipse_ring(object, frame));
}

void write_trajectory(const RunRecord& run, std::string& kml) {
  std::string times, places;
  for (const TrajectoryPoint& point : run.trajectory) {
    if (!point.position_in_enu.allFinite()) continue;
    const Geodetic place = run.local_frame->to_geodetic(point.position_in_enu.head<2>());
    times += "<when>" + iso8601(point.at) + "</when>\n";
    fmt::format_to(std::back_inserter(places), "<gx:coord>{:.9f} {:.9f} {:.2f}</gx:coord>\n",
                   place.longitude_deg, place.latitude_deg,
                   point.position_in_enu.z() - run.ground_height_above_home_m);
  }
  if (times.empty()) return;
  kml +=
      "<Placemark><name>trajectory</name><styleUrl>#trajectory</styleUrl><gx:Track>"
      "<altitudeMode>relativeToGround</altitudeMode>\n" +
      times + places + "</gx:Track></Placemark>\n";
}

}  // namespace

std::string run_to_kml(const RunRecord& run) {
  std::string kml = fmt::format(kHead, escape_markup(run.title), escape_markup(run.summary));
  if (run.local_frame) {
    kml += "<Folder><name>objects</name>\n";
    for (const ObjectReport& object : run.objects) {
      if (has_place(object)) write_object(object, *run.local_frame, kml);
    }
    kml += "</Folder>\n";
    write_trajectory(run, kml);
  }
  return kml + "</Document>\n</kml>\n";
}

}  // namespace geoloc::io
