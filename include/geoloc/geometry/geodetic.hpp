// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

namespace GeographicLib {
class LocalCartesian;
}

namespace geoloc {

/// WGS84 latitude and longitude.
struct Geodetic {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
};

/// Both finite, latitude within +-90 deg, longitude within +-360 deg.
bool is_valid(const Geodetic& point);

struct UtmPoint {
  int zone = 0;  ///< 1-60; 0 for the polar stereographic areas (UPS)
  bool north = true;
  double easting_m = 0.0;
  double northing_m = 0.0;
};

/// UTM (UPS beyond 84 N / 80 S) by GeographicLib; nullopt for an invalid point.
std::optional<UtmPoint> to_utm(const Geodetic& point);

/// A point of the local frame together with the angle between true north there and at the origin.
struct LocalPoint {
  Eigen::Vector2d position_in_enu;  ///< east, north [m]
  double convergence_rad;           ///< true north at the point, clockwise from the frame's north
};

/// Local east-north plane that touches the WGS84 ellipsoid (raised by a height) at an origin. Conversions are
/// GeographicLib's LocalCartesian, exact to nanometres; heights are kept apart from it on purpose: up in this
/// library is the height above home, which follows the ground, not the tangent plane. Horizontally the two
/// differ by less than 1 cm within 10 km of the origin.
class LocalFrame {
 public:
  /// scale_height_m: height at which metres are true, in any datum, since 100 m of error scale lengths
  /// by 1.6e-5). Throws std::invalid_argument for an invalid origin or a non-finite height.
  explicit LocalFrame(const Geodetic& origin, double scale_height_m = 0.0);

  LocalPoint to_local(const Geodetic& point) const;
  Geodetic to_geodetic(const Eigen::Vector2d& position_in_enu) const;

  const Geodetic& origin() const { return origin_; }

 private:
  Geodetic origin_;
  double scale_height_m_;
  std::shared_ptr<const GeographicLib::LocalCartesian> cartesian_;  // shared: immutable, so copies stay cheap
};

}  // namespace geoloc
