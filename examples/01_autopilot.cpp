// SPDX-License-Identifier: Apache-2.0
// An autopilot that links libgeoloc: its own state in, a detector's boxes in, geographic coordinates out.
#include <cmath>
#include <cstdio>

#include "geoloc/pipeline/geolocator.hpp"

int main() {
  geoloc::GeolocatorConfig
      config;  // every setting has a default; a downward camera of 1280 x 720, 70 degrees wide
  config.camera.mount.x_m = 0.10;  // 10 cm ahead of the centre of gravity
  geoloc::Geolocator geolocator(config);

  // A straight flight to the north at 5 m/s and 20 m, over an object that lies 30 m ahead and 3 m to the
  // right.
  const geoloc::Geodetic home{47.3977, 8.5456};
  const geoloc::LocalFrame frame(home);
  constexpr double kFocalLength_px = 914.01, kObjectNorth_m = 30.0, kObjectEast_m = 3.0, kHeight_m = 20.0;

  for (int tick = 0; tick < 1000; ++tick) {  // 100 Hz
    const geoloc::VehicleTime now{std::chrono::milliseconds{10 * tick}};
    const double north_m = 0.05 * tick;

    geoloc::PositionSample position;
    position.time = now;
    position.position = frame.to_geodetic({0.0, north_m});
    position.height_above_home_m = kHeight_m;
    geolocator.add(position);
    geolocator.add(geoloc::AttitudeSample{now, {0.0, 0.0, 0.0}});  // roll, pitch, yaw

    // The camera takes a picture now and then; the object is in it while it is near.
    const double ahead_m = kObjectNorth_m - north_m - config.camera.mount.x_m;
    if (tick % 10 != 0 || std::abs(ahead_m) > 7.0) continue;
    const double u = 640.0 + kFocalLength_px * kObjectEast_m / kHeight_m;
    const double v = 360.0 - kFocalLength_px * ahead_m / kHeight_m;
    geoloc::FrameDetections picture;
    picture.captured_at = now;
    picture.detections.push_back({{u - 18.0, v - 18.0, 36.0, 36.0}, 0.9, 0});
    geolocator.process(picture);
  }

  for (const geoloc::Track& object : geolocator.tracks()) {
    const geoloc::Geodetic where = geolocator.local_frame()->to_geodetic(object.position_in_enu.mean);
    std::printf("object %llu: %.7f, %.7f from %d looks\n", static_cast<unsigned long long>(object.id),
                where.latitude_deg, where.longitude_deg, object.hits);
  }
  return geolocator.tracks().size() == 1 ? 0 : 1;
}
