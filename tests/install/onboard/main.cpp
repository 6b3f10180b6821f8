// SPDX-License-Identifier: Apache-2.0
// Software without exceptions: it asks first, and builds what cannot fail. With an argument it does not ask.
#include <geoloc/geoloc.hpp>

#include <cstddef>
#include <cstdio>
#include <utility>
#include <vector>

#if defined(__cpp_exceptions) || defined(__cpp_rtti)
#error "to be compiled with -fno-exceptions -fno-rtti"
#endif

namespace {

using namespace std::chrono_literals;

geoloc::GeolocatorConfig usable_config() {
  geoloc::GeolocatorConfig config;
  config.joint.max_tracks = 100;
  config.max_detections = 64;
  config.camera.intrinsics = geoloc::CameraIntrinsics::from_field_of_view(1280, 720, 70.0);
  return config;
}

/// A flight of five seconds over one object.
void fly(geoloc::Geolocator& geolocator) {
  for (geoloc::VehicleTime now{0s}; now < geoloc::VehicleTime{5s}; now += 100ms) {
    geolocator.add(geoloc::AttitudeSample{now, {0.0, 0.0, 0.0}});
    geolocator.add(geoloc::PositionSample{now, {47.3977, 8.5456}, 20.0});
    geolocator.add(geoloc::FrameDetections{now - 50ms, {}, {{{740.0, 200.0, 36.0, 36.0}, 0.9, 0}}});
    while (geolocator.process_next()) {
    }
  }
}

}  // namespace

int main(int arguments, char**) {
  geoloc::GeolocatorConfig unusable = usable_config();
  unusable.max_detections = 0;
  unusable.joint.gate = -1.0;
  if (arguments > 1) return geoloc::Geolocator(unusable).tracks().empty() ? 0 : 1;  // aborts, and says why

  const auto refused = geoloc::Geolocator::create(unusable);
  if (refused || refused.error().size() != 2) return 1;
  if (geoloc::HeightGrid::problems({}, {}).empty()) return 1;

  const std::size_t bytes = geoloc::Geolocator::memory_needed(usable_config());
  auto created = geoloc::Geolocator::create(usable_config());
  if (!created) return 1;
  geoloc::Geolocator geolocator = std::move(*created);
  fly(geolocator);
  if (geolocator.tracks().size() != 1) return 1;
  const geoloc::Geodetic place =
      geolocator.local_frame()->to_geodetic(geolocator.tracks().front().position_in_enu.mean);
  std::printf("%.6f, %.6f by %.1f MB\n", place.latitude_deg, place.longitude_deg,
              1e-6 * static_cast<double>(bytes));
}
