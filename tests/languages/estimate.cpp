// SPDX-License-Identifier: Apache-2.0
// estimate FEED: the calls of tests/languages/feed.py through the library for C++.
#include <array>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <geoloc/geoloc.hpp>
#include <istream>
#include <optional>
#include <string>

namespace {

template <typename Number>
Number read_whole(std::istream& feed) {
  Number value{};
  feed >> value;
  return value;
}

geoloc::VehicleTime read_time(std::istream& feed) {
  return geoloc::VehicleTime{std::chrono::nanoseconds{read_whole<std::int64_t>(feed)}};
}

template <std::size_t N>
std::array<double, N> read_doubles(std::istream& feed) {
  std::array<double, N> values{};
  for (double& value : values) {
    std::string digits;
    feed >> digits;
    const std::uint64_t bits = std::stoull(digits, nullptr, 16);
    std::memcpy(&value, &bits, sizeof value);
  }
  return values;
}

geoloc::GeolocatorConfig read_config(std::istream& feed) {
  geoloc::GeolocatorConfig config;
  geoloc::CameraIntrinsics& lens = config.camera.intrinsics;
  geoloc::CameraMount& mount = config.camera.mount;
  lens.width_px = read_whole<int>(feed);
  lens.height_px = read_whole<int>(feed);
  const auto numbers = read_doubles<15>(feed);
  lens.fx_px = numbers[0];
  lens.fy_px = numbers[1];
  lens.cx_px = numbers[2];
  lens.cy_px = numbers[3];
  for (std::size_t i = 0; i < 5; ++i) lens.distortion[i] = numbers[4 + i];
  mount.roll_deg = numbers[9];
  mount.pitch_deg = numbers[10];
  mount.yaw_deg = numbers[11];
  mount.x_m = numbers[12];
  mount.y_m = numbers[13];
  mount.z_m = numbers[14];
  return config;
}

geoloc::AttitudeSample read_attitude(std::istream& feed) {
  const auto time = read_time(feed);
  const auto numbers = read_doubles<6>(feed);
  return {time, {numbers[0], numbers[1], numbers[2]}, Eigen::Vector3d{numbers[3], numbers[4], numbers[5]}};
}

geoloc::PositionSample read_position(std::istream& feed) {
  const auto time = read_time(feed);
  const auto numbers = read_doubles<4>(feed);
  geoloc::PositionSample position;
  position.time = time;
  position.position = {numbers[0], numbers[1]};
  position.height_above_home_m = numbers[2];
  position.height_msl_m = numbers[3];
  return position;
}

geoloc::FrameDetections read_frame(std::istream& feed) {
  geoloc::FrameDetections frame;
  frame.captured_at = read_time(feed);
  frame.captured_at_host = geoloc::HostTime{std::chrono::nanoseconds{read_whole<std::int64_t>(feed)}};
  frame.detections.resize(read_whole<std::size_t>(feed));
  for (geoloc::Detection& detection : frame.detections) {
    read_whole<char>(feed);  // D
    detection.class_id = read_whole<int>(feed);
    const auto numbers = read_doubles<5>(feed);
    detection.box = {numbers[0], numbers[1], numbers[2], numbers[3]};
    detection.confidence = numbers[4];
  }
  return frame;
}

void process(geoloc::Geolocator& geolocator, geoloc::FrameWait wait) {
  while (const auto outcome = geolocator.process_next(wait)) {
    std::printf("F %" PRId64 " %d\n", std::int64_t{outcome->captured_at.time_since_epoch().count()},
                static_cast<int>(outcome->fate));
  }
}

std::int64_t utc_ns(geoloc::HostTime time) {
  return time.time_since_epoch().count();
}

void print(const geoloc::Track& track, const geoloc::LocalFrame& frame) {
  const geoloc::Geodetic place = frame.to_geodetic(track.position_in_enu.mean);
  const auto& covariance = track.position_in_enu.covariance;
  const std::array<double, 10> numbers{place.latitude_deg,
                                       place.longitude_deg,
                                       track.position_in_enu.mean.x(),
                                       track.position_in_enu.mean.y(),
                                       covariance(0, 0),
                                       covariance(0, 1),
                                       covariance(1, 1),
                                       track.height ? track.height->above_home_m : 0.0,
                                       track.height ? track.height->sigma_m : 0.0,
                                       track.confidence()};
  std::printf("O %" PRIu64 " %d %d %" PRId64 " %" PRId64, std::uint64_t{track.id}, track.class_id(),
              track.hits, utc_ns(track.first_seen), utc_ns(track.last_seen));
  for (const double number : numbers) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &number, sizeof bits);
    std::printf(" %016" PRIx64, bits);
  }
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  std::ifstream feed(argc == 2 ? argv[1] : "");
  char kind = 0;
  if (!(feed >> kind) || kind != 'C') return 2;
  geoloc::Geolocator geolocator(read_config(feed));
  while (feed >> kind) {
    if (kind == 'A') geolocator.add(read_attitude(feed));
    if (kind == 'P') geolocator.add(read_position(feed));
    if (kind == 'F') geolocator.add(read_frame(feed));
    process(geolocator, geoloc::FrameWait::kForTelemetry);
  }
  process(geolocator, geoloc::FrameWait::kNoLonger);
  geolocator.finish();
  for (const geoloc::Track& track : geolocator.tracks()) print(track, *geolocator.local_frame());
}
