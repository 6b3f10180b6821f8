// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace geoloc::io {

/// The metadata of a picture as texts, not yet judged.
struct PictureTags {
  int width_px = 0;  ///< as stored, before any turn that its metadata ask for
  int height_px = 0;
  std::map<std::string, std::string> exif;  ///< by the names of the standard, e.g. `GPSLatitude`
  std::map<std::string, std::string> xmp;   ///< e.g. `drone-dji:GimbalYawDegree`

  std::optional<std::string> exif_text(const std::string& name) const;
  std::optional<std::string> xmp_text(const std::string& name) const;
};

/// The tags in a JPEG's bytes, of which those before the picture itself count. Throws std::runtime_error
/// naming the fault, without a file's name.
PictureTags parse_picture_tags(std::string_view jpeg);

/// The properties of an XMP packet: those of an rdf:Description by their names with prefix, those of a
/// structure below as `prefix:Structure/Name`. Throws std::runtime_error for what is no XML or larger than
/// any camera's.
std::map<std::string, std::string> parse_xmp(const std::string& packet);

}  // namespace geoloc::io
