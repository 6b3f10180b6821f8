// SPDX-License-Identifier: Apache-2.0
#include "geoloc/geometry/geodetic.hpp"

#include <GeographicLib/LocalCartesian.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <cmath>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/refuse.hpp"

namespace geoloc {

bool is_valid(const Geodetic& point) {
  return std::abs(point.latitude_deg) <= 90.0 && std::abs(point.longitude_deg) <= 360.0;  // false for NaN
}

std::optional<UtmPoint> to_utm(const Geodetic& point) {
  if (!is_valid(point)) return std::nullopt;
  UtmPoint utm;
  GeographicLib::UTMUPS::Forward(point.latitude_deg, point.longitude_deg, utm.zone, utm.north, utm.easting_m,
                                 utm.northing_m);
  return utm;
}

LocalFrame::LocalFrame(const Geodetic& origin, double scale_height_m)
    : origin_(origin), scale_height_m_(scale_height_m) {
  if (!is_valid(origin) || !std::isfinite(scale_height_m))
    refuse("LocalFrame: the origin is not a point on the WGS84 ellipsoid");
  cartesian_ = std::make_shared<const GeographicLib::LocalCartesian>(origin.latitude_deg,
                                                                     origin.longitude_deg, scale_height_m);
}

LocalPoint LocalFrame::to_local(const Geodetic& point) const {
  double x = 0.0, y = 0.0, z = 0.0;
  cartesian_->Forward(point.latitude_deg, point.longitude_deg, scale_height_m_, x, y, z);
  // Meridian convergence to first order in the longitude difference; its error is below 1e-5 rad within 50
  // km.
  const double longitude_difference_deg = std::remainder(point.longitude_deg - origin_.longitude_deg, 360.0);
  const double mean_latitude_deg = 0.5 * (point.latitude_deg + origin_.latitude_deg);
  const double convergence_rad =
      longitude_difference_deg * kRadPerDeg * std::sin(mean_latitude_deg * kRadPerDeg);
  return {{x, y}, -convergence_rad};
}

Geodetic LocalFrame::to_geodetic(const Eigen::Vector2d& position_in_enu) const {
  // The tangent plane rises above the ellipsoid with distance; two steps put the point back on it, to
  // micrometres within 100 km.
  double up = 0.0;
  Geodetic point;
  for (int step = 0; step < 3; ++step) {
    double height = 0.0;
    cartesian_->Reverse(position_in_enu.x(), position_in_enu.y(), up, point.latitude_deg, point.longitude_deg,
                        height);
    up -= height - scale_height_m_;
  }
  return point;
}

}  // namespace geoloc
