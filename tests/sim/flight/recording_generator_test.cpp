// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/flight/recording_generator.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/io/recording/recording_reader.hpp"
#include "geoloc/sim/flight/scenario.hpp"
#include "sim/flights_for_test.hpp"

namespace geoloc::sim {
namespace {

namespace fs = std::filesystem;
using Frames = std::vector<io::RecordedFrame>;

/// A perfect camera and detector: what remains is geometry.
RecordingSettings without_errors() {
  RecordingSettings settings;
  settings.run.errors = CameraErrors{0.0, 0.0, 0.0, std::nullopt, true};
  settings.detector.pixel_noise_px = settings.detector.miss_rate = settings.detector.clutter_rate = 0.0;
  return settings;
}

Frames frames_of(const Flight& flight, const RecordingSettings& settings) {
  return generate_frames(flight, settings, make_scenario(settings.run.scenario, settings.run.seed));
}

/// Maps a pixel to the plane z = 0 by the definition of the camera (CameraModel is tested against OpenCV
/// elsewhere).
Eigen::Vector2d on_ground(const Eigen::Vector2d& pixel, const CameraModel& camera,
                          const Rigid3d& enu_from_camera) {
  const Eigen::Vector3d ray = enu_from_camera.rotation * camera.ray(pixel)->normalized.homogeneous();
  return (enu_from_camera.translation - enu_from_camera.translation.z() / ray.z() * ray).head<2>();
}

struct Sample {
  double mean = 0.0;
  double sigma = 0.0;
};

Sample statistics(const std::vector<double>& values) {
  double sum = 0.0, squares = 0.0;
  for (const double value : values) sum += value;
  const double mean = sum / static_cast<double>(values.size());
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / static_cast<double>(values.size()))};
}

std::size_t detection_count(const Frames& frames) {
  std::size_t count = 0;
  for (const io::RecordedFrame& frame : frames) count += frame.detections.size();
  return count;
}

std::map<std::string, std::string> files_in(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::ifstream input(entry.path(), std::ios::binary);
    files[entry.path().filename().string()] = {std::istreambuf_iterator<char>(input), {}};
  }
  return files;
}

class OnEveryPath : public ::testing::TestWithParam<const char*> {};

TEST_P(OnEveryPath, BoxesWithoutErrorsLieOnTheirTargetsAndEveryTargetIsSeen) {
  const Flight flight = load(GetParam());
  RecordingSettings settings = without_errors();
  settings.run.camera.intrinsics.distortion = {-0.05, 0.01, 0.001, -0.0005, 0.0};
  const CameraModel camera(settings.run.camera.intrinsics);
  const Rigid3d body_from_camera = geoloc::body_from_camera(settings.run.camera.mount);
  const auto targets = make_scenario(settings.run.scenario, settings.run.seed);
  std::vector<int> looks(targets.size(), 0);
  for (const io::RecordedFrame& frame : frames_of(flight, settings)) {
    const VehicleTime time{frame.captured_at - flight.booted_at};
    const auto enu_from_body = flight.truth.pose(time);
    ASSERT_TRUE(enu_from_body);
    for (const Detection& detection : frame.detections) {
      const auto point = on_ground(detection.box.centre(), camera, *enu_from_body * body_from_camera);
      std::size_t nearest = 0;
      for (std::size_t i = 0; i < targets.size(); ++i) {
        if ((targets[i] - point).norm() < (targets[nearest] - point).norm()) nearest = i;
      }
      ASSERT_LT((targets[nearest] - point).norm(),
                0.015);  // a disc's box is not centred on its centre when tilted
      ++looks[nearest];
    }
  }
  for (const int count : looks) EXPECT_GE(count, 10);
}

INSTANTIATE_TEST_SUITE_P(Stock, OnEveryPath,
                         ::testing::Values("stock_path1", "stock_path2", "stock_path3", "stock_path4",
                                           "stock_path5", "stock_path6"));

TEST(RecordingGenerator, PixelNoiseIsAsAsked) {
  const Flight flight = load("stock_path1");
  RecordingSettings settings = without_errors();
  const Frames exact = frames_of(flight, settings);
  settings.detector.pixel_noise_px = 1.5;
  const Frames noisy = frames_of(flight, settings);
  std::vector<double> errors_px;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    ASSERT_EQ(exact[i].detections.size(), noisy[i].detections.size());
    for (std::size_t j = 0; j < exact[i].detections.size(); ++j) {
      const Eigen::Vector2d error = noisy[i].detections[j].box.centre() - exact[i].detections[j].box.centre();
      errors_px.insert(errors_px.end(), {error.x(), error.y()});
    }
  }
  ASSERT_GT(errors_px.size(), 4000U);
  EXPECT_NEAR(statistics(errors_px).mean, 0.0, 0.1);
  EXPECT_NEAR(statistics(errors_px).sigma, 1.5, 0.06);
}

TEST(RecordingGenerator, MissesAndClutterAreAsFrequentAsAsked) {
  const Flight flight = load("stock_path1");
  RecordingSettings settings = without_errors();
  settings.run.frame_rate_hz = 50.0;
  const Frames all = frames_of(flight, settings);
  settings.detector.miss_rate = 0.05;
  const auto found = static_cast<double>(detection_count(frames_of(flight, settings)));
  EXPECT_NEAR(1.0 - found / static_cast<double>(detection_count(all)), 0.05, 0.006);
  settings.detector.miss_rate = 0.0;
  settings.detector.clutter_rate = 0.03;
  const auto with_clutter = static_cast<double>(detection_count(frames_of(flight, settings)));
  const double clutter = with_clutter - static_cast<double>(detection_count(all));
  EXPECT_NEAR(clutter / static_cast<double>(all.size()), 0.03, 0.006);
}

TEST(RecordingGenerator, ClutterMayBeMoreThanABoxAFrame) {
  const Flight flight = load("stock_path1");
  RecordingSettings settings = without_errors();
  const Frames clean = frames_of(flight, settings);
  for (const double rate : {0.4, 1.0, 2.3, 5.0}) {
    settings.detector.clutter_rate = rate;
    const auto clutter =
        static_cast<double>(detection_count(frames_of(flight, settings)) - detection_count(clean));
    EXPECT_NEAR(clutter / static_cast<double>(clean.size()), rate, 0.04);
  }
}

TEST(RecordingGenerator, StampsAreLateByLatencyAndJitterAndInOrder) {
  const Flight flight = load("stock_path1");
  RecordingSettings settings = without_errors();
  const Frames exact = frames_of(flight, settings);
  settings.run.errors.latency_s = 0.12;
  settings.run.errors.latency_jitter_s = 0.01;
  const Frames late = frames_of(flight, settings);
  ASSERT_EQ(exact.size(), late.size());
  EXPECT_NEAR(static_cast<double>(exact.size()), 1600.0, 5.0);  // 160 s at 10 Hz
  std::vector<double> lateness_s;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    lateness_s.push_back(seconds(late[i].captured_at - exact[i].captured_at));
    ASSERT_TRUE(i == 0 || late[i].captured_at >= late[i - 1].captured_at);
  }
  EXPECT_NEAR(statistics(lateness_s).mean, 0.12, 0.001);
  EXPECT_NEAR(statistics(lateness_s).sigma, 0.01, 0.0006);
  settings.run.start_s = 100.0;
  settings.run.end_s = 103.0;
  settings.run.frame_rate_hz = 1000.0;  // jitter of ten frame times: stamps still do not run backwards
  const Frames fast = frames_of(flight, settings);
  for (std::size_t i = 1; i < fast.size(); ++i) ASSERT_GE(fast[i].captured_at, fast[i - 1].captured_at);
}

TEST(TrueCamera, MountingErrorIsDrawnPerAxis) {
  RunSettings settings;
  std::vector<double> errors_deg;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    const Eigen::Vector3d error_deg = make_true_camera(settings, seed).mount_error_deg;
    errors_deg.insert(errors_deg.end(), error_deg.begin(), error_deg.end());
  }
  EXPECT_NEAR(statistics(errors_deg).mean, 0.0, 0.03);
  EXPECT_NEAR(statistics(errors_deg).sigma, 0.7, 0.02);
}

TEST(TrueCamera, MountingErrorTurnsAboutTheBodysAxes) {
  const auto optical_axis_in_body = [](const std::array<double, 3>& error_deg) {
    RunSettings settings;
    settings.errors.mount_error_deg = error_deg;
    return Eigen::Vector3d(make_true_camera(settings, 0).carrier_from_camera.rotation *
                           Eigen::Vector3d::UnitZ());
  };
  const double sine = std::sin(2.0 * kRadPerDeg);
  EXPECT_NEAR(optical_axis_in_body({2.0, 0.0, 0.0}).y(), -sine, 1e-9);  // right side down: looks to the left
  EXPECT_NEAR(optical_axis_in_body({0.0, 2.0, 0.0}).x(), sine, 1e-9);   // nose up: looks ahead
  EXPECT_NEAR(optical_axis_in_body({0.0, 0.0, 2.0}).z(), 1.0, 1e-9);    // turned about its own axis
}

TEST(TrueCamera, EstimatorIsToldTheLensOnlyWhereItIsCalibrated) {
  RunSettings settings;
  settings.camera.intrinsics.distortion = {-0.1, 0.0, 0.0, 0.0, 0.0};
  EXPECT_EQ(nominal_camera(settings).intrinsics.distortion[0], -0.1);
  settings.errors.lens_is_calibrated = false;
  EXPECT_EQ(nominal_camera(settings).intrinsics.distortion[0], 0.0);
  EXPECT_EQ(make_true_camera(settings, 1).intrinsics.distortion[0], -0.1);
}

class WrittenRecording : public ::testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::path(::testing::TempDir()) / ("geoloc_recording_" + std::to_string(::getpid()));
    fs::remove_all(root_);
    fs::create_directories(root_);
  }
  void TearDown() override { fs::remove_all(root_); }

  fs::path root_;
};

TEST_F(WrittenRecording, IsByteIdenticalForEqualArgumentsAndOtherForAnotherSeed) {
  const Flight flight = load("gnss_path6");
  RecordingSettings settings;
  write_recording(root_ / "a", flight, settings);
  write_recording(root_ / "b", flight, settings);
  EXPECT_EQ(files_in(root_ / "a"), files_in(root_ / "b"));
  ++settings.run.seed;
  write_recording(root_ / "c", flight, settings);
  EXPECT_NE(files_in(root_ / "a")["frames.jsonl"], files_in(root_ / "c")["frames.jsonl"]);
}

TEST_F(WrittenRecording, IsReadBackWithTheFlightsOwnTelemetryAndTheNominalCamera) {
  const Flight flight = load("stock_path6");
  const RecordingSettings settings;
  write_recording(root_ / "a", flight, settings);
  const io::Recording recording = io::read_recording(root_ / "a");
  EXPECT_EQ(recording.truth.size(), 30U);
  EXPECT_EQ(recording.frames.size(), frames_of(flight, settings).size());
  EXPECT_EQ(recording.camera.mount.pitch_deg, -90.0);
  auto files = files_in(root_ / "a");
  EXPECT_EQ(files["telemetry.tlog"], files_in(flight_folder())["stock_path6.tlog"]);
  EXPECT_NE(files["sim.json"].find("\"mount_error_deg\""), std::string::npos);
}

TEST_F(WrittenRecording, DoesNotStartWithBadSettings) {
  const Flight flight = load("stock_path6");
  RecordingSettings settings;
  settings.run.scenario = 4;
  settings.detector.miss_rate = std::nan("");
  try {
    write_recording(root_ / "a", flight, settings);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("scenario"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("miss_rate"), std::string::npos);
  }
  settings = {};
  settings.run.end_s = 1000.0;
  EXPECT_THROW(write_recording(root_ / "a", flight, settings), std::invalid_argument);
  EXPECT_TRUE(fs::is_empty(root_));
}

}  // namespace
}  // namespace geoloc::sim
