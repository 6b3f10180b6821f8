// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/csv.hpp"

#include <fmt/format.h>

#include <cmath>

#include "geoloc/io/output/decimals.hpp"
#include "geoloc/io/output/text.hpp"

namespace geoloc::io {
namespace {

std::string number(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", decimals(value, digits), digits) : std::string();
}

}  // namespace

std::string csv_field(const std::string& text) {
  std::string clean = clean_text(text);
  if (!clean.empty() && std::string("=+-@").find(clean.front()) != std::string::npos) clean.insert(0, "'");
  if (clean.find_first_of(",\" ") == std::string::npos) return clean;
  std::string quoted = "\"";
  for (const char character : clean) {
    if (character == '"') quoted += '"';
    quoted += character;
  }
  return quoted + '"';
}

std::string objects_to_csv(const std::vector<ObjectReport>& objects) {
  std::string csv =
      "id,class_id,class_name,confidence,hits,first_seen,last_seen,latitude_deg,longitude_deg,east_m,north_m,"
      "sigma_major_m,sigma_minor_m,sigma_azimuth_deg,variance_east_m2,variance_north_m2,covariance_m2,speed_"
      "mps,"
      "course_deg,height_above_home_m,sigma_height_m,height_msl_m,"
      "operator_name,operator_verdict,height_ellipsoid_m\n";
  for (const ObjectReport& object : objects) {
    if (!has_place(object)) continue;
    const Eigen::Matrix2d& covariance = object.covariance_in_enu;
    csv += fmt::format(
        "{},{},{},{},{},{},{},{:.9f},{:.9f},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", object.id,
        object.class_id, csv_field(object.class_name), number(object.confidence, 3), object.hits,
        iso8601(object.first_seen), iso8601(object.last_seen), object.position.latitude_deg,
        object.position.longitude_deg, number(object.position_in_enu.x(), 3),
        number(object.position_in_enu.y(), 3), number(object.ellipse.sigma_major_m, 4),
        number(object.ellipse.sigma_minor_m, 4), number(object.ellipse.azimuth_deg, 1),
        number(covariance(0, 0), 6), number(covariance(1, 1), 6), number(covariance(0, 1), 6),
        object.course ? number(object.course->speed_mps, 2) : "",
        object.course ? number(object.course->direction_deg, 1) : "", number(object.height.above_home_m, 3),
        object.height.sigma_m ? number(*object.height.sigma_m, 4) : "",
        object.height.msl_m ? number(*object.height.msl_m, 3) : "", csv_field(object.note.name),
        word_of(object.note.verdict), object.height.ellipsoid_m ? number(*object.height.ellipsoid_m, 3) : "");
  }
  return csv;
}

}  // namespace geoloc::io
