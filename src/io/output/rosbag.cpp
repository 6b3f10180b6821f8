// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/rosbag.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/io/output/text.hpp"
#include "io/output/mcap_file.hpp"
#include "io/output/ros_messages.hpp"

namespace geoloc::io {
namespace {

/// The frame whose axes are east, north and up (REP 105).
constexpr const char* kMap = "map";

struct Topics {
  std::uint16_t origin, vehicle, fixes, objects, trajectory, markers;
};

struct Stamped {
  std::int64_t time_ns;
  std::uint16_t topic;
  std::string cdr;
};

/// The messages of a run, in whatever order they come.
class Messages {
 public:
  explicit Messages(const Topics& topics) : topics_(topics) {}

  void add(std::uint16_t topic, HostTime at, std::string cdr) {
    messages_.push_back({at.time_since_epoch().count(), topic, std::move(cdr)});
  }
  const Topics& topics() const { return topics_; }
  std::vector<Stamped> in_order() && {
    const auto is_before = [](const Stamped& a, const Stamped& b) { return a.time_ns < b.time_ns; };
    std::stable_sort(messages_.begin(), messages_.end(), is_before);
    return std::move(messages_);
  }

 private:
  Topics topics_;
  std::vector<Stamped> messages_;
};

Eigen::Vector4f colour(float opacity) {
  return {0.09f, 0.64f, 0.29f, opacity};
}

Eigen::Vector3d place_of(const ObjectReport& object) {
  const double up_m = object.height.above_home_m;
  return {object.position_in_enu.x(), object.position_in_enu.y(), std::isfinite(up_m) ? up_m : 0.0};
}

std::vector<Marker> markers_of(const ObjectReport& object) {
  constexpr double kTextHeight_m = 0.5, kThickness_m = 0.02;
  const auto id = static_cast<std::int32_t>(
      object.id % static_cast<std::uint64_t>(std::numeric_limits<std::int32_t>::max()));
  Marker name;
  name.group = "names";
  name.id = id;
  name.shape = MarkerShape::kText;
  name.position = place_of(object) + Eigen::Vector3d(0.0, 0.0, kTextHeight_m);
  name.size_m.setConstant(kTextHeight_m);
  name.colour = colour(1.0f);
  const std::string& called = object.note.name.empty() ? object.class_name : object.note.name;
  name.text = clean_text(called) + " " + std::to_string(object.id);
  const ErrorEllipse& ellipse = object.ellipse;
  if (!std::isfinite(ellipse.sigma_major_m + ellipse.sigma_minor_m + ellipse.azimuth_deg)) return {name};
  Marker spread = name;
  spread.group = "ellipses";
  spread.shape = MarkerShape::kCylinder;
  spread.position = place_of(object);
  spread.turned_rad = kPi / 2.0 - ellipse.azimuth_deg * kRadPerDeg;
  spread.size_m = {2.0 * kDrawnSigmas * ellipse.sigma_major_m, 2.0 * kDrawnSigmas * ellipse.sigma_minor_m,
                   kThickness_m};
  spread.colour = colour(0.5f);
  spread.text.clear();
  return {spread, name};
}

void add_objects(const RunRecord& run, Messages& messages) {
  for (const ObjectReport& object : run.objects) {
    if (!has_place(object)) continue;
    messages.add(messages.topics().objects, object.first_seen,
                 nav_sat_fix({object.first_seen, "object " + std::to_string(object.id)}, object.position,
                             object.height.ellipsoid_m, object.covariance_in_enu));
    messages.add(messages.topics().markers, object.first_seen,
                 marker_array({object.first_seen, kMap}, markers_of(object)));
  }
}

void add_fixes(const RunRecord& run, Messages& messages) {
  for (const RawFix& fix : run.raw_fixes) {
    if (!fix.position_in_enu.allFinite()) continue;
    const std::string shows =
        fix.look.object_id ? "object " + std::to_string(*fix.look.object_id) : "no object";
    messages.add(messages.topics().fixes, fix.captured_at,
                 nav_sat_fix({fix.captured_at, shows}, run.local_frame->to_geodetic(fix.position_in_enu),
                             std::nullopt, std::nullopt));
  }
}

void add_trajectory(const RunRecord& run, Messages& messages) {
  Marker line;
  line.group = "trajectory";
  line.shape = MarkerShape::kLineStrip;
  line.size_m.setConstant(0.1);
  line.colour = {0.58f, 0.64f, 0.72f, 1.0f};
  std::optional<HostTime> begin;
  for (const TrajectoryPoint& point : run.trajectory) {
    if (!point.position_in_enu.allFinite()) continue;
    if (!begin) begin = point.at;
    const Geodetic place = run.local_frame->to_geodetic(point.position_in_enu.head<2>());
    messages.add(messages.topics().vehicle, point.at,
                 nav_sat_fix({point.at, "vehicle"}, place, std::nullopt, std::nullopt));
    messages.add(messages.topics().trajectory, point.at,
                 point_stamped({point.at, kMap}, point.position_in_enu));
    line.points.push_back(point.position_in_enu);
  }
  if (!begin) return;
  messages.add(messages.topics().origin, *begin,
               nav_sat_fix({*begin, kMap}, run.local_frame->origin(), std::nullopt, std::nullopt));
  messages.add(messages.topics().markers, *begin, marker_array({*begin, kMap}, {line}));
}

}  // namespace

std::string run_to_rosbag(const RunRecord& run) {
  McapFile bag;
  const auto topic = [&bag](const char* name, const RosType& type) {
    return bag.add_topic(name, type.name, type.definition);
  };
  Messages messages(
      {topic("/geoloc/origin", nav_sat_fix_type()), topic("/geoloc/vehicle", nav_sat_fix_type()),
       topic("/geoloc/fixes", nav_sat_fix_type()), topic("/geoloc/objects", nav_sat_fix_type()),
       topic("/geoloc/trajectory", point_stamped_type()), topic("/geoloc/markers", marker_array_type())});
  if (run.local_frame) {
    add_trajectory(run, messages);
    add_fixes(run, messages);
    add_objects(run, messages);
  }
  for (const Stamped& message : std::move(messages).in_order())
    bag.add(message.topic, message.time_ns, message.cdr);
  return bag.finish();
}

}  // namespace geoloc::io
