// SPDX-License-Identifier: Apache-2.0
#include <geoloc/pipeline/geolocator.hpp>

int main() {
  const geoloc::Geolocator geolocator{geoloc::GeolocatorConfig{}};
  return geolocator.tracks().empty() ? 0 : 1;
}
