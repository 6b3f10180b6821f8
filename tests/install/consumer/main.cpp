// SPDX-License-Identifier: Apache-2.0
#include <geoloc/geoloc.hpp>

int main() {
  const geoloc::Geolocator geolocator{geoloc::GeolocatorConfig{}};
  const auto zurich = geoloc::to_utm({47.4, 8.5});  // by GeographicLib, which the consumer does not name
  return geolocator.tracks().empty() && zurich && zurich->zone == 32 ? 0 : 1;
}
