// SPDX-License-Identifier: Apache-2.0
// An autopilot that links libgeoloc: its own state in, a detector's boxes in, geographic coordinates out.
#include <geoloc/geoloc.hpp>

#include <cmath>
#include <cstdio>
#include <optional>

namespace {

using namespace std::chrono_literals;

// A straight flight to the north at 5 m/s and 20 m, over an object that lies 30 m ahead and 3 m to the right.
constexpr geoloc::Geodetic kHome{47.3977, 8.5456};
constexpr double kSpeed_mps = 5.0, kHeight_m = 20.0, kObjectNorth_m = 30.0, kObjectEast_m = 3.0;

double north_m(geoloc::VehicleTime time) {
  return kSpeed_mps * geoloc::seconds(time.time_since_epoch());
}

geoloc::PositionSample position_at(geoloc::VehicleTime time) {
  geoloc::PositionSample position;
  position.time = time;
  position.position = geoloc::LocalFrame(kHome).to_geodetic({0.0, north_m(time)});
  position.height_above_home_m = kHeight_m;
  return position;
}

/// The box that a detector finds while the object is in the picture of a camera that looks straight down.
geoloc::FrameDetections picture_at(geoloc::VehicleTime time, const geoloc::CameraConfig& camera) {
  geoloc::FrameDetections picture;
  picture.captured_at = time;
  const double ahead_m = kObjectNorth_m - north_m(time) - camera.mount.x_m;
  if (std::abs(ahead_m) > 7.0) return picture;  // nothing was found: that is information, too
  const double u = 640.0 + camera.intrinsics.fx_px * kObjectEast_m / kHeight_m;
  const double v = 360.0 - camera.intrinsics.fy_px * ahead_m / kHeight_m;
  picture.detections.push_back({{u - 18.0, v - 18.0, 36.0, 36.0}, 0.9, 0});
  return picture;
}

/// What to do each time that something was added. False where a frame is lost.
bool process_frames(geoloc::Geolocator& geolocator) {
  bool all_located = true;
  while (const auto frame = geolocator.process_next()) {
    if (frame->is_located()) continue;
    std::printf("frame of %.2f s: %s\n", geoloc::seconds(frame->captured_at.time_since_epoch()),
                geoloc::explain(frame->fate));
    all_located = false;
  }
  return all_located;
}

}  // namespace

int main() {
  geoloc::GeolocatorConfig config;  // every setting has a default; the camera looks straight down
  config.camera.intrinsics = geoloc::CameraIntrinsics::from_field_of_view(1280, 720, 70.0);
  config.camera.mount.x_m = 0.10;  // 10 cm ahead of the centre of gravity
  geoloc::Geolocator geolocator(config);

  bool all_located = true;
  for (geoloc::VehicleTime now{0s}; now <= geoloc::VehicleTime{10s}; now += 50ms) {
    const auto since_start = now.time_since_epoch();
    if (since_start % 100ms == 0ms) {                                // telemetry at 10 Hz
      geolocator.add(geoloc::AttitudeSample{now, {0.0, 0.0, 0.0}});  // roll, pitch, yaw
      geolocator.add(position_at(now));
    }
    if (since_start % 100ms == 50ms && since_start > 150ms)  // the detector takes 0.1 s for each picture
      geolocator.add(picture_at(now - 100ms, config.camera));
    all_located = process_frames(geolocator) && all_located;
  }
  geolocator.finish();

  const geoloc::Geolocator::Counters& counters = geolocator.counters();
  std::printf("frames %llu, located %llu\n", static_cast<unsigned long long>(counters.frames),
              static_cast<unsigned long long>(counters.frames_located));
  for (const geoloc::Track& object : geolocator.tracks()) {
    const geoloc::Geodetic where = geolocator.local_frame()->to_geodetic(object.position_in_enu.mean);
    std::printf("object %llu: %.7f, %.7f from %d looks\n", static_cast<unsigned long long>(object.id),
                where.latitude_deg, where.longitude_deg, object.hits);
  }
  return all_located && geolocator.tracks().size() == 1 ? 0 : 1;
}
