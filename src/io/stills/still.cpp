// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/stills/still.hpp"

#include <cmath>
#include <stdexcept>

#include "io/stills/tag_values.hpp"

namespace geoloc::io {
namespace {

constexpr double kMostHeight_m = 50e3;

std::optional<double> first_of(const PictureTags& tags, std::initializer_list<const char*> xmp_names) {
  for (const char* name : xmp_names) {
    if (const auto value = number_of(tags.xmp_text(name))) return value;
  }
  return std::nullopt;
}

std::optional<double> angle_deg(const PictureTags& tags, const char* name, const char* negative) {
  const auto text = tags.exif_text(name);
  const std::vector<double> parts = text ? numbers_in(*text) : std::vector<double>{};
  if (parts.size() != 3) return std::nullopt;
  const double value = parts[0] + parts[1] / 60.0 + parts[2] / 3600.0;
  const std::string reference = tags.exif_text(std::string(name) + "Ref").value_or("");
  return reference.rfind(negative, 0) == 0 ? -value : value;
}

std::optional<Geodetic> exif_position(const PictureTags& tags) {
  const auto latitude_deg = angle_deg(tags, "GPSLatitude", "S");
  const auto longitude_deg = angle_deg(tags, "GPSLongitude", "W");
  if (!latitude_deg || !longitude_deg) return std::nullopt;
  return Geodetic{*latitude_deg, *longitude_deg};
}

/// XMP has more digits. DJI misspells the longitude in some models.
std::optional<Geodetic> xmp_position(const PictureTags& tags) {
  const auto latitude_deg = first_of(tags, {"drone-dji:GpsLatitude", "drone-skydio:Latitude"});
  const auto longitude_deg =
      first_of(tags, {"drone-dji:GpsLongitude", "drone-dji:GpsLongtitude", "drone-skydio:Longitude"});
  if (!latitude_deg || !longitude_deg) return std::nullopt;
  return Geodetic{*latitude_deg, *longitude_deg};
}

bool is_near(const Geodetic& a, const Geodetic& b) {
  constexpr double kNear_deg = 1e-4;  // some 10 m
  return std::abs(a.latitude_deg - b.latitude_deg) < kNear_deg &&
         std::abs(a.longitude_deg - b.longitude_deg) * std::cos(a.latitude_deg * 0.0174533) < kNear_deg;
}

/// EXIF's is what every program reads, so it decides where the two contradict each other.
Geodetic position_of(const PictureTags& tags) {
  const bool has_no_fix = tags.exif_text("GPSStatus").value_or("").rfind('V', 0) == 0 ||
                          tags.xmp_text("drone-dji:GpsStatus").value_or("") == "Invalid";
  if (has_no_fix) throw std::runtime_error("says that its receiver had no fix");
  const auto exif = exif_position(tags);
  const auto xmp = xmp_position(tags);
  if (!exif && !xmp) throw std::runtime_error("tells no position");
  const Geodetic position = exif && (!xmp || !is_near(*exif, *xmp)) ? *exif : *xmp;
  const bool is_place = is_valid(position) && std::abs(position.longitude_deg) <= 180.0 &&
                        (position.latitude_deg != 0.0 || position.longitude_deg != 0.0);
  if (!is_place) throw std::runtime_error("tells a position that is none (0, 0, or beyond the Earth)");
  return position;
}

std::optional<double> credible_height(std::optional<double> height_m) {
  if (height_m && !(std::abs(*height_m) <= kMostHeight_m)) return std::nullopt;
  return height_m;
}

/// EXIF's reference: 1 is below sea level; 2 and 3 count from the ellipsoid.
void take_exif_height(const PictureTags& tags, Still& still) {
  const auto height_m = credible_height(number_of(tags.exif_text("GPSAltitude")));
  if (!height_m) return;
  const std::string reference = tags.exif_text("GPSAltitudeRef").value_or("0");
  const char kind = reference.empty() ? '0' : reference.back();  // 0x01
  const bool is_below = kind == '1' || kind == '3';
  still.height_absolute_m = is_below ? -std::abs(*height_m) : *height_m;
  if (kind == '2' || kind == '3') still.datum = HeightDatum::kEllipsoid;
}

/// DJI's with RTK count from the ellipsoid.
void take_heights(const PictureTags& tags, Still& still) {
  still.height_above_take_off_m =
      credible_height(first_of(tags, {"drone-dji:RelativeAltitude", "drone:RelativeAltitude",
                                      "drone-skydio:RelativeAltitude", "Camera:AboveGroundAltitude"}));
  take_exif_height(tags, still);
  const auto absolute_m = credible_height(first_of(
      tags, {"drone-dji:AbsoluteAltitude", "drone:AbsoluteAltitude", "drone-skydio:AbsoluteAltitude"}));
  if (absolute_m) still.height_absolute_m = absolute_m;
  constexpr int kSingle = 16;
  const bool is_by_rtk = tags.xmp_text("drone-dji:AltitudeType").value_or("") == "RtkAlt" ||
                         still.rtk_flag.value_or(0) >= kSingle;
  if (is_by_rtk) still.datum = HeightDatum::kEllipsoid;
}

std::optional<double> credible_sigma(std::optional<double> sigma_m) {
  if (sigma_m && !(*sigma_m > 0.0 && *sigma_m < 1e3)) return std::nullopt;
  return sigma_m;
}

void take_accuracy(const PictureTags& tags, Still& still) {
  const auto flag = number_of(tags.xmp_text("drone-dji:RtkFlag"));
  if (flag && *flag >= 0.0 && *flag <= 1e3) still.rtk_flag = static_cast<int>(*flag);
  const auto east_m = number_of(tags.xmp_text("drone-dji:RtkStdLon"));
  const auto north_m = number_of(tags.xmp_text("drone-dji:RtkStdLat"));
  if (east_m && north_m) still.sigma_horizontal_m = credible_sigma(std::hypot(*east_m, *north_m));
  if (!still.sigma_horizontal_m)
    still.sigma_horizontal_m = credible_sigma(first_of(tags, {"Camera:GPSXYAccuracy"}));
  if (!still.sigma_horizontal_m)
    still.sigma_horizontal_m = credible_sigma(number_of(tags.exif_text("GPSHPositioningError")));
  still.sigma_height_m = credible_sigma(first_of(tags, {"drone-dji:RtkStdHgt", "Camera:GPSZAccuracy"}));
}

}  // namespace

Still still_of(const PictureTags& tags) {
  constexpr double kUpright = 1.0;
  const double orientation = number_of(tags.exif_text("Orientation")).value_or(kUpright);
  if (orientation > kUpright && orientation <= 8.0)
    throw std::runtime_error(
        "is to be turned when it is shown (EXIF Orientation), so that its camera's angles are in doubt");
  Still still;
  still.width_px = tags.width_px;
  still.height_px = tags.height_px;
  still.taken = capture_time_of(tags);
  still.position = position_of(tags);
  take_accuracy(tags, still);
  take_heights(tags, still);
  still.attitude = attitude_of(tags);
  still.lens = lens_of(tags);
  return still;
}

}  // namespace geoloc::io
