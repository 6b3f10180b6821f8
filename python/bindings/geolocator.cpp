// SPDX-License-Identifier: Apache-2.0
#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "flight_feed.hpp"
#include "geoloc/geoloc.hpp"
#include "rows.hpp"
#include "settings.hpp"
#include "values.hpp"

namespace geoloc::python {
namespace {

/// The Geolocator behind Python's: calls of several threads come one after the other, without Python's lock.
class Estimator {
 public:
  /// Frames that wait no longer: their times on the vehicle's clock [ns], and FrameFate.
  using Outcomes = std::vector<std::pair<std::int64_t, int>>;

  explicit Estimator(const std::string& settings_json) : feed_(config_from(settings_json)) {}

  void add_attitudes(const Integers& times_ns, const Table<3>& angles_rad,
                     const std::optional<Table<3>>& rates_radps) {
    require_rows(angles_rad.shape(0), times_ns.size());
    if (rates_radps) require_rows(rates_radps->shape(0), times_ns.size());
    const nb::gil_scoped_release unlocked;
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < times_ns.size(); ++i) {
      const double* angles = angles_rad.data() + 3 * i;
      AttitudeSample sample{time_of(times_ns, i), {angles[0], angles[1], angles[2]}};
      if (rates_radps) sample.rates_in_body_radps = vector3(rates_radps->data() + 3 * i);
      feed_.expect(sample);
    }
  }

  /// Columns: latitude, longitude [deg], height above home, height above the sea, 1-sigma horizontally [m],
  /// and the velocity's east, north, up [m/s]; NaN in the latter five where it is not told.
  void add_positions(const Integers& times_ns, const Table<8>& positions) {
    require_rows(positions.shape(0), times_ns.size());
    const nb::gil_scoped_release unlocked;
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < times_ns.size(); ++i) {
      const double* row = positions.data() + 8 * i;
      PositionSample sample{time_of(times_ns, i), {row[0], row[1]},   row[2],
                            unless_nan(row[3]),   unless_nan(row[4]), std::nullopt};
      if (!std::isnan(row[5])) sample.velocity_in_enu = vector3(row + 5);
      feed_.expect(sample);
    }
  }

  void add_gimbals(const Integers& times_ns, const Table<4>& level_from_gimbal_wxyz, bool from_north,
                   std::optional<bool> holds_direction) {
    require_rows(level_from_gimbal_wxyz.shape(0), times_ns.size());
    const nb::gil_scoped_release unlocked;
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < times_ns.size(); ++i) {
      const double* wxyz = level_from_gimbal_wxyz.data() + 4 * i;
      feed_.expect(GimbalSample{time_of(times_ns, i),
                                {wxyz[0], wxyz[1], wxyz[2], wxyz[3]},
                                from_north ? GimbalYaw::kFromNorth : GimbalYaw::kFromNose,
                                holds_direction});
    }
  }

  void add_ranges(const Integers& times_ns, const Numbers& distances_m) {
    require_rows(distances_m.size(), times_ns.size());
    const nb::gil_scoped_release unlocked;
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < times_ns.size(); ++i)
      feed_.expect(RangeSample{time_of(times_ns, i), distances_m.data()[i]});
  }

  /// NaN: not told.
  void add_fields_of_view(const Integers& times_ns, const Table<2>& angles_rad) {
    require_rows(angles_rad.shape(0), times_ns.size());
    const nb::gil_scoped_release unlocked;
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < times_ns.size(); ++i) {
      const double* angles = angles_rad.data() + 2 * i;
      feed_.expect(FieldOfViewSample{time_of(times_ns, i), unless_nan(angles[0]), unless_nan(angles[1])});
    }
  }

  Outcomes process(std::int64_t time_ns, std::int64_t utc_ns, double time_sigma_s, const Table<4>& boxes_px,
                   const Numbers& confidences, const Integers& class_ids, const Numbers& sigmas_px,
                   const std::optional<std::string>& mount_json,
                   const std::optional<std::array<double, 2>>& focal_px) {
    const std::size_t count = boxes_px.shape(0);
    require_rows(confidences.size(), count);
    require_rows(class_ids.size(), count);
    require_rows(sigmas_px.size(), count);
    FrameDetections frame;
    frame.captured_at = VehicleTime{Duration{time_ns}};
    frame.captured_at_host = HostTime{Duration{utc_ns}};
    frame.time_sigma_s = time_sigma_s;
    for (std::size_t i = 0; i < count; ++i) {
      const double* box = boxes_px.data() + 4 * i;
      frame.detections.push_back({{box[0], box[1], box[2], box[3]},
                                  confidences.data()[i],
                                  static_cast<int>(class_ids.data()[i]),
                                  sigmas_px.data()[i]});
    }
    if (mount_json) frame.mount = mount_from(*mount_json);
    if (focal_px) frame.focal_px = Eigen::Vector2d((*focal_px)[0], (*focal_px)[1]);

    const nb::gil_scoped_release unlocked;
    const std::lock_guard lock(mutex_);
    return told(feed_.process(frame));
  }

  /// The frames that wait no longer, as after telemetry has come.
  Outcomes process_waiting() {
    const nb::gil_scoped_release unlocked;
    const std::lock_guard lock(mutex_);
    return told(feed_.process_waiting());
  }

  Outcomes finish() {
    const nb::gil_scoped_release unlocked;
    const std::lock_guard lock(mutex_);
    return told(feed_.finish());
  }

  Outcomes on_vehicle_reboot() {
    const nb::gil_scoped_release unlocked;
    const std::lock_guard lock(mutex_);
    return told(feed_.on_vehicle_reboot());
  }

  nb::bytes objects(bool confirmed_only) {
    const std::lock_guard lock(mutex_);
    return bytes_of(rows_of<ObjectRow>(
        feed_.geolocator().tracks(), feed_.geolocator().local_frame(),
        [=](const Track& track) { return !confirmed_only || track.status == TrackStatus::kConfirmed; }));
  }

  nb::bytes fixes() {
    const std::lock_guard lock(mutex_);
    return bytes_of(rows_of<FixRow>(feed_.geolocator().located(), feed_.geolocator().local_frame(),
                                    [](const LocatedDetection&) { return true; }));
  }

  std::optional<Fields> calibration() {
    const std::lock_guard lock(mutex_);
    return calibration_of(feed_.geolocator().calibration());
  }

  Counts counters() {
    const std::lock_guard lock(mutex_);
    Counts counts = counts_of(feed_.geolocator());
    counts["samples_waiting"] = feed_.samples_waiting();
    return counts;
  }

  /// None before a frame was located; else the camera's position [m] and w, x, y, z of its rotation.
  std::optional<std::array<double, 7>> camera_pose() {
    const std::lock_guard lock(mutex_);
    if (feed_.geolocator().counters().frames_located == 0) return std::nullopt;
    const FrameView& view = feed_.geolocator().view();
    const Eigen::Vector3d& at = view.enu_from_camera.translation;
    const Eigen::Quaterniond& turn = view.enu_from_camera.rotation;
    return std::array{at.x(), at.y(), at.z() - view.lifted_m, turn.w(), turn.x(), turn.y(), turn.z()};
  }

  /// None before the first position.
  std::optional<std::pair<double, double>> origin() {
    const std::lock_guard lock(mutex_);
    if (!feed_.geolocator().local_frame()) return std::nullopt;
    const Geodetic& origin = feed_.geolocator().local_frame()->origin();
    return std::make_pair(origin.latitude_deg, origin.longitude_deg);
  }

  std::pair<double, double> to_geodetic(double east_m, double north_m) {
    const Geodetic where = frame().to_geodetic({east_m, north_m});
    return {where.latitude_deg, where.longitude_deg};
  }

  std::pair<double, double> to_local(double latitude_deg, double longitude_deg) {
    const Geodetic where{latitude_deg, longitude_deg};
    if (!is_valid(where)) throw std::invalid_argument("latitude_deg and longitude_deg are no place on Earth");
    const Eigen::Vector2d position = frame().to_local(where).position_in_enu;
    return {position.x(), position.y()};
  }

 private:
  static VehicleTime time_of(const Integers& times_ns, std::size_t i) {
    return VehicleTime{Duration{times_ns.data()[i]}};
  }

  static Outcomes told(const FlightFeed::Outcomes& outcomes) {
    Outcomes pairs;
    for (const FrameOutcome& outcome : outcomes)
      pairs.emplace_back(outcome.captured_at.time_since_epoch().count(), static_cast<int>(outcome.fate));
    return pairs;
  }

  LocalFrame frame() {
    const std::lock_guard lock(mutex_);
    if (!feed_.geolocator().local_frame())
      throw std::invalid_argument("no position of the vehicle has come yet");
    return *feed_.geolocator().local_frame();
  }

  std::mutex mutex_;
  FlightFeed feed_;
};

}  // namespace

void bind_geolocator(nb::module_& module) {
  module.def(
      "memory_needed",
      [](const std::string& settings_json) { return Geolocator::memory_needed(config_from(settings_json)); },
      nb::arg("settings_json"));
  nb::class_<Estimator>(module, "Estimator")
      .def(nb::init<const std::string&>(), nb::arg("settings_json"))
      .def("add_attitudes", &Estimator::add_attitudes, nb::arg("times_ns"), nb::arg("angles_rad"),
           nb::arg("rates_radps").none())
      .def("add_positions", &Estimator::add_positions, nb::arg("times_ns"), nb::arg("positions"))
      .def("add_gimbals", &Estimator::add_gimbals, nb::arg("times_ns"), nb::arg("level_from_gimbal_wxyz"),
           nb::arg("from_north"), nb::arg("holds_direction").none())
      .def("add_ranges", &Estimator::add_ranges, nb::arg("times_ns"), nb::arg("distances_m"))
      .def("add_fields_of_view", &Estimator::add_fields_of_view, nb::arg("times_ns"), nb::arg("angles_rad"))
      .def("process", &Estimator::process, nb::arg("time_ns"), nb::arg("utc_ns"), nb::arg("time_sigma_s"),
           nb::arg("boxes_px"), nb::arg("confidences"), nb::arg("class_ids"), nb::arg("sigmas_px"),
           nb::arg("mount_json").none(), nb::arg("focal_px").none())
      .def("process_waiting", &Estimator::process_waiting)
      .def("finish", &Estimator::finish)
      .def("on_vehicle_reboot", &Estimator::on_vehicle_reboot)
      .def("objects", &Estimator::objects, nb::arg("confirmed_only"))
      .def("fixes", &Estimator::fixes)
      .def("calibration", &Estimator::calibration)
      .def("counters", &Estimator::counters)
      .def("camera_pose", &Estimator::camera_pose)
      .def("origin", &Estimator::origin)
      .def("to_geodetic", &Estimator::to_geodetic, nb::arg("east_m"), nb::arg("north_m"))
      .def("to_local", &Estimator::to_local, nb::arg("latitude_deg"), nb::arg("longitude_deg"));
}

}  // namespace geoloc::python
