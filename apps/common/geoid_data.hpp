// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/io/output/geoid.hpp"

namespace geoloc::apps {

/// The geoid that the user has installed for GeographicLib, or else the one that is built with the programs.
io::Geoid open_geoid();

}  // namespace geoloc::apps
