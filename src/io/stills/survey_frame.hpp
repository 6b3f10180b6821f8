// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "geoloc/geometry/geodetic.hpp"

namespace geoloc::io {

/// The coordinate system that a list of ground control points begins with: `EPSG:4326`, `WGS84 UTM 33N`, or
/// PROJ's `+proj=…`.
class SurveyFrame {
 public:
  /// Throws std::runtime_error for a system that is not known.
  explicit SurveyFrame(const std::string& line);
  ~SurveyFrame();
  SurveyFrame(const SurveyFrame&) = delete;
  SurveyFrame& operator=(const SurveyFrame&) = delete;

  /// The place of an easting (or longitude) and northing (or latitude); nullopt where they are none.
  std::optional<Geodetic> to_geodetic(double x, double y) const;

 private:
  struct Transform;
  std::unique_ptr<Transform> transform_;
};

}  // namespace geoloc::io
