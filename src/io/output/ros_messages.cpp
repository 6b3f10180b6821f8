// SPDX-License-Identifier: Apache-2.0
#include "io/output/ros_messages.hpp"

#include <array>
#include <chrono>
#include <cmath>
#include <limits>

namespace geoloc::io {
namespace {

// The parts that definitions are made of, each after the line that names it.
constexpr const char* kHeaderParts = R"(
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
)";
constexpr const char* kPointPart =
    R"(================================================================================
MSG: geometry_msgs/Point
float64 x
float64 y
float64 z
)";

void add_header(const RosHeader& header, CdrMessage& message) {
  const auto since_1970 = header.at.time_since_epoch();
  const auto whole = std::chrono::floor<std::chrono::seconds>(since_1970);
  message.add(static_cast<std::int32_t>(whole.count()))
      .add(static_cast<std::uint32_t>((since_1970 - whole).count()))
      .add_text(header.frame);
}

void add_point(const Eigen::Vector3d& point, CdrMessage& message) {
  for (const double coordinate : {point.x(), point.y(), point.z()}) message.add(coordinate);
}

void add_marker(const RosHeader& header, const Marker& marker, CdrMessage& message) {
  add_header(header, message);
  message.add_text(marker.group)
      .add(marker.id)
      .add(static_cast<std::int32_t>(marker.shape))
      .add(std::int32_t{0});  // to be added
  add_point(marker.position, message);
  message.add(0.0).add(0.0).add(std::sin(0.5 * marker.turned_rad)).add(std::cos(0.5 * marker.turned_rad));
  add_point(marker.size_m, message);
  for (const float part : {marker.colour[0], marker.colour[1], marker.colour[2], marker.colour[3]})
    message.add(part);
  message.add(std::int32_t{0}).add(std::uint32_t{0});  // for ever
  message.add(false);                                  // stays where its frame was then
  message.add_count(marker.points.size());
  for (const Eigen::Vector3d& point : marker.points) add_point(point, message);
  message.add_count(0).add_text("");  // colours, and a texture:
  add_header({}, message);
  message.add_text("").add_count(0).add_count(0);
  message.add_text(marker.text);
  message.add_text("").add_text("").add_count(0).add(false);  // meshes
}

}  // namespace

RosType nav_sat_fix_type() {
  return {"sensor_msgs/msg/NavSatFix",
          std::string(R"(uint8 COVARIANCE_TYPE_UNKNOWN=0
uint8 COVARIANCE_TYPE_APPROXIMATED=1
std_msgs/Header header
sensor_msgs/NavSatStatus status
float64 latitude
float64 longitude
float64 altitude
float64[9] position_covariance
uint8 position_covariance_type)") +
              kHeaderParts +
              R"(================================================================================
MSG: sensor_msgs/NavSatStatus
int8 status
uint16 service
)"};
}

RosType point_stamped_type() {
  return {"geometry_msgs/msg/PointStamped",
          std::string("std_msgs/Header header\ngeometry_msgs/Point point") + kHeaderParts + kPointPart};
}

RosType marker_array_type() {
  return {"visualization_msgs/msg/MarkerArray",
          std::string(R"(visualization_msgs/Marker[] markers
================================================================================
MSG: visualization_msgs/Marker
std_msgs/Header header
string ns
int32 id
int32 type
int32 action
geometry_msgs/Pose pose
geometry_msgs/Vector3 scale
std_msgs/ColorRGBA color
builtin_interfaces/Duration lifetime
bool frame_locked
geometry_msgs/Point[] points
std_msgs/ColorRGBA[] colors
string texture_resource
sensor_msgs/CompressedImage texture
visualization_msgs/UVCoordinate[] uv_coordinates
string text
string mesh_resource
visualization_msgs/MeshFile mesh_file
bool mesh_use_embedded_materials)") +
              kHeaderParts + kPointPart +
              R"(================================================================================
MSG: geometry_msgs/Pose
geometry_msgs/Point position
geometry_msgs/Quaternion orientation
================================================================================
MSG: geometry_msgs/Quaternion
float64 x
float64 y
float64 z
float64 w
================================================================================
MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z
================================================================================
MSG: std_msgs/ColorRGBA
float32 r
float32 g
float32 b
float32 a
================================================================================
MSG: builtin_interfaces/Duration
int32 sec
uint32 nanosec
================================================================================
MSG: sensor_msgs/CompressedImage
std_msgs/Header header
string format
uint8[] data
================================================================================
MSG: visualization_msgs/UVCoordinate
float32 u
float32 v
================================================================================
MSG: visualization_msgs/MeshFile
string filename
uint8[] data
)"};
}

std::string nav_sat_fix(const RosHeader& header, const Geodetic& place,
                        std::optional<double> height_ellipsoid_m,
                        const std::optional<Eigen::Matrix2d>& covariance) {
  constexpr std::uint8_t kUnknown = 0, kApproximated = 1;
  CdrMessage message;
  add_header(header, message);
  message.add(std::int8_t{0}).add(std::uint16_t{0});  // a fix, by no satellites of its own
  message.add(place.latitude_deg)
      .add(place.longitude_deg)
      .add(height_ellipsoid_m.value_or(std::numeric_limits<double>::quiet_NaN()));
  const bool is_known = covariance && covariance->allFinite();
  const Eigen::Matrix2d C = is_known ? *covariance : Eigen::Matrix2d::Zero();
  for (const double entry : {C(0, 0), C(0, 1), 0.0, C(1, 0), C(1, 1), 0.0, 0.0, 0.0, 0.0}) message.add(entry);
  return message.add(is_known ? kApproximated : kUnknown).bytes();
}

std::string point_stamped(const RosHeader& header, const Eigen::Vector3d& point) {
  CdrMessage message;
  add_header(header, message);
  add_point(point, message);
  return message.bytes();
}

std::string marker_array(const RosHeader& header, const std::vector<Marker>& markers) {
  CdrMessage message;
  message.add_count(markers.size());
  for (const Marker& marker : markers) add_marker(header, marker, message);
  return message.bytes();
}

}  // namespace geoloc::io
