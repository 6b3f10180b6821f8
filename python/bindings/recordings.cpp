// SPDX-License-Identifier: Apache-2.0
#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/estimation_config.hpp"
#include "common/recorded_config.hpp"
#include "common/replay.hpp"
#include "common/run_record.hpp"
#include "common/run_score.hpp"
#include "common/session.hpp"
#include "common/session_summary.hpp"
#include "files.hpp"
#include "geoloc/evaluation/score.hpp"
#include "geoloc/io/atomic_file.hpp"
#include "geoloc/io/output/geoid.hpp"
#include "geoloc/io/output/geojson.hpp"
#include "geoloc/io/output/raw_fixes.hpp"
#include "geoloc/io/recording/recording_reader.hpp"
#include "rows.hpp"
#include "values.hpp"

namespace geoloc::python {
namespace {

/// The recording's own settings, under those given; the camera is the recording's, unless these name another.
apps::EstimationConfig config_of(const io::Recording& recording, const std::string& settings_json) {
  apps::EstimationConfig config;
  if (recording.config_json)
    apps::apply_settings(apps::recorded_settings(*recording.config_json), "the recording's config", config);
  config.geolocator.camera = recording.camera;
  apps::apply_settings(nlohmann::json::parse(settings_json), "settings", config);
  return config;
}

io::Recording read(const std::string& folder, bool keep_going) {
  const nb::gil_scoped_release unlocked;
  return io::read_recording(folder, keep_going ? io::BadLines::kSkip : io::BadLines::kRefuse);
}

bool is_interrupted() {
  const nb::gil_scoped_acquire locked;
  return PyErr_CheckSignals() != 0;
}

/// A flight's name is the caller's, and may be unusable.
void require_usable(const FlightSummary& summary) {
  for (const std::string& problem : summary.problems()) throw std::invalid_argument(problem);
}

/// Settings by themselves, over the defaults, every one with its value; faults throw.
std::string complete_settings(const std::string& settings_json) {
  apps::EstimationConfig config;
  apps::apply_settings(nlohmann::json::parse(settings_json), "settings", config);
  return apps::estimation_to_json(config).dump();
}

/// A recording that was replayed to its end, with what came of it.
class Run {
 public:
  Run(io::Recording recording, const std::string& settings_json)
      : recording_(std::move(recording)), session_(config_of(recording_, settings_json)) {
    session_.note_damaged(recording_.frames_damaged);
    constexpr std::size_t kFramesBetweenLooks = 64;  // for Ctrl-C
    std::size_t frames = 0;
    bool is_stopped = false;
    {
      const nb::gil_scoped_release unlocked;
      apps::replay(recording_.telemetry, recording_.frames, session_, [&](const apps::PendingFrame&, bool) {
        is_stopped = ++frames % kFramesBetweenLooks == 0 && is_interrupted();
        return !is_stopped;
      });
      record_ = apps::record_run(session_, recording_.class_names, recording_.truth, "");
      io::Geoid().complete(record_.objects);
    }
    if (is_stopped) throw nb::python_error();
  }

  nb::bytes objects() const {
    return bytes_of(
        rows_of<ObjectRow>(session_.geolocator().tracks(), record_.local_frame,
                           [](const Track& track) { return track.status == TrackStatus::kConfirmed; }));
  }
  nb::bytes fixes() const {
    return bytes_of(
        rows_of<RawFixRow>(record_.raw_fixes, record_.local_frame, [](const io::RawFix&) { return true; }));
  }
  nb::bytes trajectory() const {
    return bytes_of(rows_of<TrajectoryRow>(record_.trajectory, record_.local_frame,
                                           [](const io::TrajectoryPoint&) { return true; }));
  }
  std::optional<Fields> calibration() const { return calibration_of(session_.geolocator().calibration()); }
  const std::string& summary() const { return record_.summary; }
  const std::vector<std::string>& class_names() const { return recording_.class_names; }
  std::optional<FlightSummary> flight_summary(const std::string& flight_id,
                                              const std::string& part_of) const {
    std::optional<FlightSummary> summary = apps::summarize_session(session_, flight_id, part_of);
    if (summary) require_usable(*summary);
    return summary;
  }
  std::string geojson() const { return io::objects_to_geojson(record_.objects, record_.estimator); }

  /// Empty before the first position.
  std::string fixes_csv() const {
    return record_.local_frame ? io::raw_fixes_to_csv(record_.raw_fixes, *record_.local_frame) : "";
  }

  /// Against other targets than the recording's own, where they are given.
  Fields score(const std::optional<std::string>& truth_geojson) const;

 private:
  io::Recording recording_;
  apps::Session session_;
  io::RunRecord record_;
};

Fields to_dict(const Score& score) {
  Fields result;
  result["targets"] = score.targets;
  result["objects"] = score.objects;
  result["found"] = score.found;
  result["extra"] = score.extra;
  result["merged_pairs"] = score.merged_pairs;
  result["rmse_m"] = score.rmse_m;
  result["relative_rmse_m"] = score.relative_rmse_m;
  result["target_of_object"] = score.target_of_object;
  return result;
}

Fields Run::score(const std::optional<std::string>& truth_geojson) const {
  const std::vector<io::TrueTarget> truth =
      truth_geojson ? io::parse_truth(*truth_geojson, "truth") : recording_.truth;
  const auto [scored, told] = apps::without_known_points(session_, truth);
  const Score score = apps::score_run(session_, scored, told);
  Fields result = to_dict(score);
  result["mean_nees"] = apps::mean_nees_of_run(session_, scored, score, told);
  const auto heights = apps::score_heights_of_run(session_, scored, score, told);
  result["height_rmse_m"] = heights ? std::optional<double>(heights->rmse_m) : std::nullopt;
  return result;
}

/// East and north [m] about the first of the targets.
std::vector<Eigen::Vector2d> in_enu(const Table<2>& latitudes_longitudes_deg, const LocalFrame& frame) {
  std::vector<Eigen::Vector2d> places;
  for (std::size_t i = 0; i < latitudes_longitudes_deg.shape(0); ++i) {
    const double* row = latitudes_longitudes_deg.data() + 2 * i;
    if (!is_valid(Geodetic{row[0], row[1]}))
      throw std::invalid_argument("row " + std::to_string(i) + " is no place on Earth");
    places.push_back(frame.to_local({row[0], row[1]}).position_in_enu);
  }
  return places;
}

Fields score_places(const Table<2>& objects_deg, const Table<2>& targets_deg) {
  const Table<2>& first = targets_deg.shape(0) > 0 ? targets_deg : objects_deg;
  if (first.shape(0) == 0) return to_dict(score_objects({}, {}));
  const LocalFrame frame({first.data()[0], first.data()[1]});
  return to_dict(score_objects(in_enu(objects_deg, frame), in_enu(targets_deg, frame)));
}

}  // namespace

void bind_recordings(nb::module_& module) {
  nb::class_<Files>(module, "Files")
      .def(nb::init<>())
      .def_rw("camera_json", &Files::camera_json)
      .def_prop_rw(
          "frames_jsonl",
          [](const Files& files) { return nb::bytes(files.frames_jsonl.data(), files.frames_jsonl.size()); },
          [](Files& files, const nb::bytes& bytes) {
            files.frames_jsonl.assign(bytes.c_str(), bytes.size());
          })
      .def_prop_rw(
          "telemetry",
          [](const Files& files) { return nb::bytes(files.telemetry.data(), files.telemetry.size()); },
          [](Files& files, const nb::bytes& bytes) {
            const auto* begin = static_cast<const std::uint8_t*>(bytes.data());
            files.telemetry.assign(begin, begin + bytes.size());
          })
      .def_rw("config_json", &Files::config_json, nb::arg().none())
      .def_rw("truth_geojson", &Files::truth_geojson, nb::arg().none())
      .def_rw("class_names", &Files::class_names)
      .def_rw("frames_damaged", &Files::frames_damaged);
  module.def(
      "read_recording",
      [](const std::string& folder, bool keep_going) {
        return or_value_error([&] {
          const io::Recording recording = read(folder, keep_going);
          const nb::gil_scoped_release unlocked;
          return std::make_pair(files_of(recording), recording.skipped.count);
        });
      },
      nb::arg("folder"), nb::arg("keep_going"));
  module.def(
      "write_recording",
      [](const Files& files, const std::string& folder) {
        const nb::gil_scoped_release unlocked;
        const io::Recording recording = or_value_error([&] { return recording_of(files); });
        write(recording, folder);
      },
      nb::arg("files"), nb::arg("folder"));
  nb::class_<Run>(module, "Run")
      .def(
          "__init__",
          [](Run* place, const Files& files, const std::string& settings_json) {
            or_value_error([&] { return new (place) Run(recording_of(files), settings_json); });
          },
          nb::arg("files"), nb::arg("settings_json"))
      .def(
          "__init__",
          [](Run* place, const std::string& folder, bool keep_going, const std::string& settings_json) {
            or_value_error([&] { return new (place) Run(read(folder, keep_going), settings_json); });
          },
          nb::arg("folder"), nb::arg("keep_going"), nb::arg("settings_json"))
      .def("objects", &Run::objects)
      .def("fixes", &Run::fixes)
      .def("trajectory", &Run::trajectory)
      .def("calibration", &Run::calibration)
      .def("summary", &Run::summary)
      .def("class_names", &Run::class_names)
      .def("flight_summary", &Run::flight_summary, nb::arg("flight_id"), nb::arg("part_of"))
      .def("geojson", &Run::geojson)
      .def("fixes_csv", &Run::fixes_csv)
      .def(
          "score",
          [](const Run& run, const std::optional<std::string>& truth) {
            return or_value_error([&] { return run.score(truth); });
          },
          nb::arg("truth_geojson").none());
  module.def(
      "complete_settings",
      [](const std::string& settings_json) {
        return or_value_error([&] { return complete_settings(settings_json); });
      },
      nb::arg("settings_json"));
  module.def("has_geoid", [] { return io::Geoid().is_installed(); });
  module.def("score_places", &score_places, nb::arg("objects_deg"), nb::arg("targets_deg"));
  module.def(
      "write_file",
      [](const std::string& file, const std::string& content) {
        const nb::gil_scoped_release unlocked;
        io::write_file_atomically(file, content);
      },
      nb::arg("file"), nb::arg("content"));
}

}  // namespace geoloc::python
