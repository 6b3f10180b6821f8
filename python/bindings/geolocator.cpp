// SPDX-License-Identifier: Apache-2.0
#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "geoloc/geoloc.hpp"
#include "geoloc/io/config/geolocator_fields.hpp"
#include "geoloc/io/json/camera_fields.hpp"
#include "rows.hpp"
#include "values.hpp"

namespace geoloc::python {
namespace {

[[noreturn]] void refuse(const std::vector<std::string>& problems) {
  std::string all = "unusable configuration:";
  for (const std::string& problem : problems) all += "\n  " + problem;
  throw std::invalid_argument(all);
}

GeolocatorConfig config_from(const std::string& settings_json) {
  GeolocatorConfig config;
  std::vector<std::string> problems;
  io::geolocator_from_json(nlohmann::json::parse(settings_json), config, problems);
  if (!problems.empty()) refuse(problems);
  return config;
}

CameraMount mount_from(const std::string& mount_json) {
  CameraMount mount;
  std::vector<std::string> problems;
  io::mount_from_json(nlohmann::json::parse(mount_json), "mount", mount, problems);
  if (!problems.empty()) refuse(problems);
  return mount;
}

void require_rows(std::size_t rows, std::size_t wanted) {
  if (rows != wanted) throw std::invalid_argument("arrays of different lengths");
}

std::optional<double> unless_nan(double value) {
  return std::isnan(value) ? std::nullopt : std::optional<double>(value);
}

Eigen::Vector3d vector3(const double* values) {
  return {values[0], values[1], values[2]};
}

/// The Geolocator behind Python's: calls of several threads come one after the other, without Python's lock.
class Estimator {
 public:
  /// Frames that wait no longer: their times on the vehicle's clock [ns], and FrameFate.
  using Outcomes = std::vector<std::pair<std::int64_t, int>>;

  explicit Estimator(const std::string& settings_json) : geolocator_(config_from(settings_json)) {}

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
      expect(sample);
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
      expect(sample);
    }
  }

  void add_gimbals(const Integers& times_ns, const Table<4>& level_from_gimbal_wxyz, bool from_north,
                   std::optional<bool> holds_direction) {
    require_rows(level_from_gimbal_wxyz.shape(0), times_ns.size());
    const nb::gil_scoped_release unlocked;
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < times_ns.size(); ++i) {
      const double* wxyz = level_from_gimbal_wxyz.data() + 4 * i;
      expect(GimbalSample{time_of(times_ns, i),
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
      expect(RangeSample{time_of(times_ns, i), distances_m.data()[i]});
  }

  /// NaN: not told.
  void add_fields_of_view(const Integers& times_ns, const Table<2>& angles_rad) {
    require_rows(angles_rad.shape(0), times_ns.size());
    const nb::gil_scoped_release unlocked;
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < times_ns.size(); ++i) {
      const double* angles = angles_rad.data() + 2 * i;
      expect(FieldOfViewSample{time_of(times_ns, i), unless_nan(angles[0]), unless_nan(angles[1])});
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
    Outcomes outcomes;
    feed_until(frame.captured_at + kAhead, outcomes);
    if (const auto gone = geolocator_.add(frame)) note(*gone, outcomes);
    process_all(FrameWait::kForTelemetry, outcomes);
    newest_frame_ = frame.captured_at;
    return outcomes;
  }

  /// The frames that wait no longer, as after telemetry has come.
  Outcomes process_waiting() {
    const nb::gil_scoped_release unlocked;
    const std::lock_guard lock(mutex_);
    Outcomes outcomes;
    if (newest_frame_) feed_until(*newest_frame_ + kAhead, outcomes);
    process_all(FrameWait::kForTelemetry, outcomes);
    return outcomes;
  }

  Outcomes finish() {
    const nb::gil_scoped_release unlocked;
    const std::lock_guard lock(mutex_);
    Outcomes outcomes;
    feed_until(VehicleTime::max(), outcomes);
    process_all(FrameWait::kNoLonger, outcomes);
    geolocator_.finish();
    return outcomes;
  }

  Outcomes on_vehicle_reboot() {
    const nb::gil_scoped_release unlocked;
    const std::lock_guard lock(mutex_);
    Outcomes outcomes;
    feed_until(VehicleTime::max(), outcomes);
    geolocator_.on_vehicle_reboot();
    newest_frame_.reset();
    return outcomes;
  }

  nb::bytes objects(bool confirmed_only) {
    const std::lock_guard lock(mutex_);
    return bytes_of(rows_of<ObjectRow>(
        geolocator_.tracks(), geolocator_.local_frame(),
        [=](const Track& track) { return !confirmed_only || track.status == TrackStatus::kConfirmed; }));
  }

  nb::bytes fixes() {
    const std::lock_guard lock(mutex_);
    return bytes_of(rows_of<FixRow>(geolocator_.located(), geolocator_.local_frame(),
                                    [](const LocatedDetection&) { return true; }));
  }

  std::optional<Fields> calibration() {
    const std::lock_guard lock(mutex_);
    return calibration_of(geolocator_.calibration());
  }

  Counts counters();

  /// None before a frame was located; else the camera's position [m] and w, x, y, z of its rotation.
  std::optional<std::array<double, 7>> camera_pose() {
    const std::lock_guard lock(mutex_);
    if (geolocator_.counters().frames_located == 0) return std::nullopt;
    const FrameView& view = geolocator_.view();
    const Eigen::Vector3d& at = view.enu_from_camera.translation;
    const Eigen::Quaterniond& turn = view.enu_from_camera.rotation;
    return std::array{at.x(), at.y(), at.z() - view.lifted_m, turn.w(), turn.x(), turn.y(), turn.z()};
  }

  /// None before the first position.
  std::optional<std::pair<double, double>> origin() {
    const std::lock_guard lock(mutex_);
    if (!geolocator_.local_frame()) return std::nullopt;
    const Geodetic& origin = geolocator_.local_frame()->origin();
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

  static void note(const FrameOutcome& outcome, Outcomes& outcomes) {
    outcomes.emplace_back(outcome.captured_at.time_since_epoch().count(), static_cast<int>(outcome.fate));
  }

  using Sample = std::variant<AttitudeSample, PositionSample, GimbalSample, RangeSample, FieldOfViewSample>;

  /// What comes in arrays may be a whole flight of one kind, and the estimator keeps a few seconds.
  template <typename T>
  void expect(const T& sample) {
    expected_.emplace(sample.time, sample);
  }

  /// Samples in the order of their times, and the frames that waited for them.
  void feed_until(VehicleTime end, Outcomes& outcomes) {
    while (!expected_.empty() && expected_.begin()->first <= end) {
      std::visit([&](const auto& sample) { geolocator_.add(sample); }, expected_.begin()->second);
      expected_.erase(expected_.begin());
      process_all(FrameWait::kForTelemetry, outcomes);
    }
  }

  void process_all(FrameWait wait, Outcomes& outcomes) {
    while (const auto processed = geolocator_.process_next(wait)) note(*processed, outcomes);
  }

  LocalFrame frame() {
    const std::lock_guard lock(mutex_);
    if (!geolocator_.local_frame()) throw std::invalid_argument("no position of the vehicle has come yet");
    return *geolocator_.local_frame();
  }

  /// So much telemetry after a frame is fed with it.
  static constexpr Duration kAhead = std::chrono::seconds{1};

  std::mutex mutex_;
  Geolocator geolocator_;
  std::multimap<VehicleTime, Sample> expected_;  // in order of their times, not fed yet
  std::optional<VehicleTime> newest_frame_;
};

Counts Estimator::counters() {
  const std::lock_guard lock(mutex_);
  const Geolocator::Counters& frames = geolocator_.counters();
  const StateProvider::Counters state = geolocator_.state().counters();
  const TrackCounters& tracks = geolocator_.track_counters();
  Counts counts;
  counts["frames"] = frames.frames;
  counts["frames_located"] = frames.frames_located;
  counts["frames_waiting"] = geolocator_.frames_waiting();
  counts["samples_waiting"] = expected_.size();
  counts["detections"] = frames.detections;
  counts["detections_dropped"] = frames.detections_dropped;
  counts["detections_at_edge"] = frames.detections_at_edge;
  counts["attitudes"] = state.attitudes;
  counts["positions"] = state.positions;
  counts["gimbals"] = state.gimbals;
  counts["focal_lengths"] = state.focal_lengths;
  counts["ranges"] = frames.ranges;
  counts["duplicates"] = state.duplicates;
  counts["stale"] = state.stale;
  counts["invalid"] = state.invalid;
  counts["out_of_range"] = state.out_of_range;
  counts["too_far"] = state.too_far;
  counts["reboots"] = state.reboots;
  counts["tracks_created"] = tracks.created;
  counts["tracks_removed"] = tracks.removed;
  counts["tracks_merged"] = tracks.merged;
  counts["tracks_refused"] = tracks.refused;
  return counts;
}

}  // namespace

void bind_geolocator(nb::module_& module) {
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
  module.def(
      "explain",
      [](int fate) {
        if (fate < 0 || fate >= static_cast<int>(kFrameFates)) throw std::invalid_argument("no frame's fate");
        return explain(static_cast<FrameFate>(fate));
      },
      nb::arg("fate"));
}

}  // namespace geoloc::python
