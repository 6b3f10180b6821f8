// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/live_page/coordinate_texts.hpp"

#include <fmt/format.h>

#include <GeographicLib/DMS.hpp>
#include <GeographicLib/MGRS.hpp>
#include <GeographicLib/UTMUPS.hpp>

namespace geoloc::io {
namespace {

constexpr unsigned kDecimalsOfSeconds = 3;  // 3 cm
constexpr int kMgrsMetre = 5;

/// GeographicLib writes 22d54'22.044"S.
std::string with_signs(const std::string& dms) {
  std::string text;
  for (const char character : dms) {
    if (character == 'd') {
      text += "°";
    } else if (character == '\'') {
      text += "′";
    } else if (character == '"') {
      text += "″";
    } else {
      text += character;
    }
  }
  return text;
}

std::string dms_text(const Geodetic& place) {
  using GeographicLib::DMS;
  return with_signs(DMS::Encode(place.latitude_deg, DMS::SECOND, kDecimalsOfSeconds, DMS::LATITUDE) + " " +
                    DMS::Encode(place.longitude_deg, DMS::SECOND, kDecimalsOfSeconds, DMS::LONGITUDE));
}

/// "23K" of "23KPQ9144265634": the band's letter tells the hemisphere where N and S could be either.
std::string zone_and_band(const std::string& mgrs) {
  return mgrs.substr(0, mgrs.find_first_not_of("0123456789") + 1);
}

}  // namespace

CoordinateTexts coordinate_texts(const Geodetic& place) {
  if (!is_valid(place)) return {};
  CoordinateTexts texts;
  texts.degrees = fmt::format("{:.8f}, {:.8f}", place.latitude_deg, place.longitude_deg);
  texts.dms = dms_text(place);
  int zone = 0;
  bool is_north = true;
  double easting_m = 0.0, northing_m = 0.0;
  GeographicLib::UTMUPS::Forward(place.latitude_deg, place.longitude_deg, zone, is_north, easting_m,
                                 northing_m);
  GeographicLib::MGRS::Forward(zone, is_north, easting_m, northing_m, place.latitude_deg, kMgrsMetre,
                               texts.mgrs);
  texts.utm = fmt::format("{} {:.2f} E {:.2f} N", zone_and_band(texts.mgrs), easting_m, northing_m);
  return texts;
}

}  // namespace geoloc::io
