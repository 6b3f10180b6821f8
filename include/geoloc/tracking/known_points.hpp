// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/geometry/geodetic.hpp"

namespace geoloc {

/// An object whose place was surveyed. One or two take the receiver's constant offset out of all others.
struct KnownPoint {
  std::string name;
  Geodetic position;
  double sigma_m = 0.05;        ///< 1-sigma per axis of the survey
  double height_m = 0.0;        ///< above any level that is the same for all points
  double sigma_height_m = 0.0;  ///< 1-sigma of it; 0: the height is not known
  std::optional<int> class_id;  ///< unset: any

  std::vector<std::string> problems() const;
};

enum class KnownPointStatus {
  kNotCovered,  ///< the camera has not looked there for long enough
  kNoObject,    ///< it has, and no object there agrees with the survey and with the other points
  kAmbiguous,   ///< several objects may be the one
  kMatched
};

/// What became of a known point.
struct KnownPointMatch {
  KnownPointStatus status = KnownPointStatus::kNotCovered;
  std::uint64_t track_id = 0;  ///< of the object that it was matched to
};

}  // namespace geoloc
