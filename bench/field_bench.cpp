// SPDX-License-Identifier: Apache-2.0
// What a frame costs in a flight over N objects: field_bench N [MINUTES]. The vehicle mows a square field at
// 20 m with thirty objects in view, ten frames a second. Prints the time of process() in the first thousand
// frames after the start and in the last thousand, and the memory. With MINUTES it flies over the field again
// and again for so long; where that is more than twenty, the first thousand are those from the tenth on. In
// the two hundred frames before the last thousand it also times the outputs of a frame: its report in the
// estimator's thread, JSON Lines and the page in their own.
#include <time.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "geoloc/io/live_page/live_document.hpp"
#include "geoloc/io/output/json_lines.hpp"
#include "geoloc/io/output/output_frame.hpp"
#include "geoloc/pipeline/geolocator.hpp"

namespace {

using namespace geoloc;

constexpr double kHeight_m = 20.0, kSpeed_mps = 5.0, kPeriod_s = 0.1;
constexpr double kInView = 30.0, kOverlap = 0.3;
constexpr double kNoise_px = 1.0, kFound = 0.95;
constexpr std::size_t kFramesTold = 1000, kFramesToBegin = 200, kFramesOfTenMinutes = 6000;
constexpr double kFramesOfOutputs = 200.0;

/// Places in a square grid from the origin on, each a little beside its node.
class Field {
 public:
  Field(std::size_t count, double spacing_m)
      : side_(static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))))), spacing_m_(spacing_m) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> aside(-0.2 * spacing_m, 0.2 * spacing_m);
    for (int row = 0; row < side_; ++row) {
      for (int column = 0; column < side_; ++column)
        places_.emplace_back(spacing_m * column + aside(random), spacing_m * row + aside(random));
    }
  }

  double length_m() const { return spacing_m_ * side_; }
  std::size_t size() const { return places_.size(); }

  template <typename Visit>
  void for_each_within(const Eigen::Vector2d& centre, double reach_m, const Visit& visit) const {
    const auto index = [&](double along_m) {
      return std::clamp(static_cast<int>(along_m / spacing_m_), 0, side_ - 1);
    };
    for (int row = index(centre.y() - reach_m); row <= index(centre.y() + reach_m); ++row) {
      for (int column = index(centre.x() - reach_m); column <= index(centre.x() + reach_m); ++column)
        visit(places_[static_cast<std::size_t>(row) * static_cast<std::size_t>(side_) +
                      static_cast<std::size_t>(column)]);
    }
  }

 private:
  int side_;
  double spacing_m_;
  std::vector<Eigen::Vector2d> places_;
};

/// Where a vehicle is that goes up and down the field, lane by lane, and the same way back again.
class Mower {
 public:
  Mower(double length_m, double lane_m)
      : length_m_(length_m), lane_m_(length_m / std::max(1.0, std::ceil(length_m / lane_m))) {
    lanes_ = static_cast<int>(std::lround(length_m_ / lane_m_));
  }

  double minutes() const { return (lanes_ * (length_m_ + lane_m_) - lane_m_) / kSpeed_mps / 60.0; }

  Eigen::Vector2d at(double time_s) const {
    const double per_lane_m = length_m_ + lane_m_, once_m = lanes_ * per_lane_m - lane_m_;
    const double there_and_back_m = std::fmod(kSpeed_mps * time_s, 2.0 * once_m);
    const double way_m = std::min(there_and_back_m, 2.0 * once_m - there_and_back_m);
    const int lane = std::min(lanes_ - 1, static_cast<int>(way_m / per_lane_m));
    const double along_m = std::min(length_m_, way_m - per_lane_m * lane);
    const double aside_m = std::max(0.0, way_m - per_lane_m * lane - length_m_);
    return {lane_m_ * (lane + 0.5) + aside_m, lane % 2 == 0 ? along_m : length_m_ - along_m};
  }

 private:
  double length_m_, lane_m_;
  int lanes_;
};

EulerAngles tilt_at(double time_s) {
  return {0.03 * std::sin(0.9 * time_s), 0.02 * std::sin(1.3 * time_s), 0.0};
}

void report(Geolocator& geolocator, const LocalFrame& earth, double time_s, const Eigen::Vector2d& place) {
  const VehicleTime time{from_seconds(time_s)};
  geolocator.add(AttitudeSample{time, tilt_at(time_s)});
  PositionSample position;
  position.time = time;
  position.position = earth.to_geodetic(place);
  position.height_above_home_m = kHeight_m;
  geolocator.add(position);
}

/// Boxes of what the camera shows, from straight above but for the tilt.
void see(const Field& field, double time_s, const Eigen::Vector2d& place, const CameraIntrinsics& camera,
         std::mt19937& random, std::vector<Detection>& boxes) {
  std::normal_distribution<double> noise(0.0, kNoise_px);
  std::uniform_real_distribution<double> chance;
  boxes.clear();
  const EulerAngles tilt = tilt_at(time_s);
  const double cr = std::cos(tilt.roll_rad), sr = std::sin(tilt.roll_rad);
  const double cp = std::cos(tilt.pitch_rad), sp = std::sin(tilt.pitch_rad);
  field.for_each_within(place, 25.0, [&](const Eigen::Vector2d& object) {
    const double east = object.x() - place.x(), north = object.y() - place.y(), down = kHeight_m;
    const double nose = cp * north - sp * down, right = sr * sp * north + cr * east + sr * cp * down;
    const double belly = cr * sp * north - sr * east + cr * cp * down;
    const double u = camera.cx_px + camera.fx_px * right / belly + noise(random);
    const double v = camera.cy_px - camera.fy_px * nose / belly + noise(random);
    if (chance(random) > kFound || u < 20.0 || v < 20.0) return;
    if (u > camera.width_px - 20.0 || v > camera.height_px - 20.0) return;
    boxes.push_back({{u + 0.5 - 18.0, v + 0.5 - 18.0, 36.0, 36.0}, 0.9, 0});
  });
}

struct Quantiles {
  double median_us, p99_us, worst_us;
};

Quantiles quantiles_of(std::vector<double> times_us) {
  std::sort(times_us.begin(), times_us.end());
  return {times_us[times_us.size() / 2], times_us[times_us.size() * 99 / 100], times_us.back()};
}

/// Processor time of this thread alone, so that other processes do not count.
double cpu_time_us() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e6 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_nsec);
}

/// What the outputs of a frame take.
class Outputs {
 public:
  void tell(const Geolocator& geolocator, HostTime captured_at, const std::vector<Detection>& detections) {
    std::optional<io::OutputFrame> frame;
    const auto timed = [](std::vector<double>& times_us, const auto& step) {
      const double begin_us = cpu_time_us();
      step();
      times_us.push_back(cpu_time_us() - begin_us);
    };
    timed(report_us_, [&] { frame = reporter_.report(geolocator, true, captured_at, detections); });
    timed(lines_us_, [&] { lines_.frame(*frame); });
    timed(page_us_, [&] { page_.add(*frame); });
  }

  void print() const {
    std::printf("outputs, medians: report %.0f us, JSON Lines %.0f us, page %.0f us\n",
                quantiles_of(report_us_).median_us, quantiles_of(lines_us_).median_us,
                quantiles_of(page_us_).median_us);
  }

 private:
  io::FrameReporter reporter_{{"object"}};
  io::JsonLines lines_;
  io::LiveDocument page_{{"field_bench", true}};
  std::vector<double> report_us_, lines_us_, page_us_;
};

double resident_mb() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("VmRSS:", 0) == 0) return std::stod(line.substr(6)) / 1024.0;
  }
  return 0.0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: field_bench OBJECTS [MINUTES]\n");
    return 2;
  }
  GeolocatorConfig config;
  config.joint.max_tracks = 1'000'000;
  config.joint.horizontal_accuracy_m = 0.3;
  const CameraIntrinsics& camera = config.camera.intrinsics;
  const double across_m = kHeight_m * camera.width_px / camera.fx_px;
  const double along_m = kHeight_m * camera.height_px / camera.fy_px;
  const Field field(std::strtoul(argv[1], nullptr, 10), std::sqrt(across_m * along_m / kInView));
  const Mower mower(field.length_m(), (1.0 - kOverlap) * across_m);
  const double end_s = 60.0 * (argc > 2 ? std::strtod(argv[2], nullptr) : mower.minutes());

  const double memory_before_mb = resident_mb();
  double memory_mb = 0.0;  // without the outputs
  const LocalFrame earth({47.0, 8.0});
  Geolocator geolocator(config);
  FrameDetections frame;
  std::mt19937 random(1);
  std::vector<double> times_us;
  std::size_t detections = 0, frames = 0;
  Outputs outputs;
  for (double told_s = 0.0; told_s < 1.0; told_s += kPeriod_s)
    report(geolocator, earth, told_s, mower.at(told_s));
  for (; kPeriod_s * static_cast<double>(frames) < end_s; ++frames) {
    const double time_s = kPeriod_s * static_cast<double>(frames);
    report(geolocator, earth, time_s + 1.0, mower.at(time_s + 1.0));
    see(field, time_s, mower.at(time_s), camera, random, frame.detections);
    frame.captured_at = VehicleTime{from_seconds(time_s)};
    frame.captured_at_host = HostTime{from_seconds(time_s)};
    detections += frame.detections.size();
    const double begin_us = cpu_time_us();
    if (!geolocator.process(frame)) std::fprintf(stderr, "frame %zu has no state\n", frames);
    times_us.push_back(cpu_time_us() - begin_us);
    const double left = end_s / kPeriod_s - static_cast<double>(frames + kFramesTold);
    if (left > 0.0 && left <= kFramesOfOutputs) {
      if (memory_mb == 0.0) memory_mb = resident_mb() - memory_before_mb;
      outputs.tell(geolocator, frame.captured_at_host, frame.detections);
    }
  }
  outputs.print();
  std::size_t confirmed = 0;
  for (const Track& track : geolocator.tracks()) confirmed += track.status == TrackStatus::kConfirmed;
  const auto part = [&](std::size_t begin) {
    const auto first = times_us.begin() + static_cast<std::ptrdiff_t>(std::min(begin, times_us.size() - 1));
    const auto count = std::min<std::ptrdiff_t>(kFramesTold, times_us.end() - first);
    return quantiles_of({first, first + count});
  };
  const Quantiles early = part(frames > 2 * kFramesOfTenMinutes ? kFramesOfTenMinutes : kFramesToBegin),
                  late = part(times_us.size() - std::min(times_us.size(), kFramesTold));
  const Quantiles all = quantiles_of({times_us.begin() + kFramesToBegin, times_us.end()});
  std::printf(
      "%6zu objects, %6zu frames of %.1f: %zu confirmed, %zu tracks; first median %.0f p99 %.0f us; last "
      "median %.0f p99 %.0f "
      "worst %.0f us; all median %.0f p99 %.0f worst %.0f us; %.0f MB\n",
      field.size(), frames, static_cast<double>(detections) / static_cast<double>(frames), confirmed,
      geolocator.tracks().size(), early.median_us, early.p99_us, late.median_us, late.p99_us, late.worst_us,
      all.median_us, all.p99_us, all.worst_us, memory_mb);
}
