// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/geometry/geodetic.hpp"
#include "geoloc/geometry/time.hpp"
#include "io/output/cdr.hpp"

namespace geoloc::io {

/// A type of messages of ROS 2 (Humble and later), as McapFile::add_topic() takes it.
struct RosType {
  std::string name;
  std::string definition;
};
RosType nav_sat_fix_type();
RosType point_stamped_type();
RosType marker_array_type();

/// When, and in which frame: the head of every message. Text must be valid UTF-8 without NUL.
struct RosHeader {
  HostTime at;
  std::string frame;
};

/// sensor_msgs/NavSatFix. Its altitude is not a number where the height above the ellipsoid is not known, and
/// its covariance is unknown where none is given: of east and north [m^2].
std::string nav_sat_fix(const RosHeader& header, const Geodetic& place,
                        std::optional<double> height_ellipsoid_m,
                        const std::optional<Eigen::Matrix2d>& covariance);

/// geometry_msgs/PointStamped [m].
std::string point_stamped(const RosHeader& header, const Eigen::Vector3d& point);

/// What a visualization_msgs/Marker shows.
enum class MarkerShape : std::int32_t { kCylinder = 3, kLineStrip = 4, kText = 9 };
struct Marker {
  std::string group;
  std::int32_t id = 0;
  MarkerShape shape = MarkerShape::kCylinder;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double turned_rad = 0.0;  ///< about the vertical, counter-clockwise from above
  Eigen::Vector3d size_m =
      Eigen::Vector3d::Ones();  ///< along its own axes; of a line its width, of a text its height
  Eigen::Vector4f colour = Eigen::Vector4f::Ones();  ///< red, green, blue, opacity
  std::vector<Eigen::Vector3d> points;               ///< of a line
  std::string text;
};

/// visualization_msgs/MarkerArray: each stays until one of its group and id takes its place.
std::string marker_array(const RosHeader& header, const std::vector<Marker>& markers);

}  // namespace geoloc::io
