// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdlib>
#include <exception>
#include <string>

#include "geoloc/camera/camera.hpp"
#include "geoloc/io/stills/labels.hpp"
#include "geoloc/io/stills/still.hpp"

// Pictures, XMP packets and labels of any bytes: they are refused with a std::exception, or what they tell is
// usable. Violations abort. Shared by the fuzz programs and by the test that damages good files.
namespace geoloc::io::hostile {

inline void require_usable(bool holds) {
  if (!holds) std::abort();
}

inline void require_usable(const std::optional<double>& value) {
  require_usable(!value || std::isfinite(*value));
}

inline void require_usable(const Still& still) {
  require_usable(is_valid(still.position));
  require_usable(still.height_above_take_off_m);
  require_usable(still.height_absolute_m);
  require_usable(!still.sigma_horizontal_m || *still.sigma_horizontal_m > 0.0);
  require_usable(!still.sigma_height_m || *still.sigma_height_m > 0.0);
  const EulerAngles& angles = still.attitude.vehicle;
  require_usable(std::isfinite(angles.roll_rad) && std::isfinite(angles.pitch_rad) &&
                 std::isfinite(angles.yaw_rad));
  require_usable(CameraConfig{{}, still.attitude.mount}.problems().empty());
  if (still.lens) require_usable(CameraConfig{still.lens->intrinsics, {}}.problems().empty());
}

/// A picture's bytes.
inline void read_any_still(const std::string& bytes) {
  try {
    require_usable(still_of(parse_picture_tags(bytes)));
  } catch (const std::exception&) {
  }
}

/// A packet, as the only metadata beside a position.
inline void read_any_xmp(const std::string& packet) {
  try {
    PictureTags tags{4000, 3000, {{"GPSLatitude", "(46) (50) (34)"}, {"GPSLongitude", "(9) (5) (3)"}}, {}};
    tags.xmp = parse_xmp(packet);
    require_usable(still_of(tags));
  } catch (const std::exception&) {
  }
}

/// --labels.
inline void read_any_labels(const std::string& text) {
  try {
    const Labels labels = parse_labels(text, "any");
    require_usable(!labels.by_picture.empty());
    for (const auto& [picture, detections] : labels.by_picture) {
      for (const Detection& detection : detections)
        require_usable(std::isfinite(detection.box.x) && std::isfinite(detection.box.y) &&
                       detection.box.width > 0.0 && detection.box.height > 0.0 &&
                       detection.confidence >= 0.0 && detection.confidence <= 1.0 && detection.class_id >= 0);
    }
    for (const SurveyedMark& mark : labels.marks)
      require_usable(is_valid(mark.position) && std::isfinite(mark.height_m));
  } catch (const std::exception&) {
  }
}

}  // namespace geoloc::io::hostile
