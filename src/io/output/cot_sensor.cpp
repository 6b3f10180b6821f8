// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/cot_sensor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geoloc/io/output/cot_event.hpp"
#include "geoloc/io/output/markup.hpp"

namespace geoloc::io {
namespace {

std::string uid_of_vehicle(const CotViewContext& context) {
  return escape_markup(context.uid + ".vehicle");
}

/// All of an event but its detail. What is seen once is out of date after some periods.
std::string event(const std::string& uid, const std::string& type, const Geodetic& place, double hae_m,
                  const std::string& detail, const CotViewContext& context, const CotConfig& config) {
  constexpr double kPeriods = 5.0;
  const HostTime stale_at = context.sent_at + from_seconds(kPeriods * config.sensor_period_s);
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\"?>\n"
      "<event version=\"2.0\" uid=\"{}\" type=\"{}\" how=\"m-g\" time=\"{}\" start=\"{}\" stale=\"{}\">"
      "<point lat=\"{:.8f}\" lon=\"{:.8f}\" hae=\"{:.2f}\" ce=\"{:.2f}\" le=\"{:.2f}\"/>"
      "<detail>{}</detail></event>\n",
      uid, type, iso8601(context.sent_at), iso8601(std::min(context.captured_at, context.sent_at)),
      iso8601(stale_at), place.latitude_deg, place.longitude_deg, std::isfinite(hae_m) ? hae_m : kCotUnknown,
      kCotUnknown, kCotUnknown, detail);
}

}  // namespace

std::string vehicle_to_cot(const ViewReport& view, const CotViewContext& context, const CotConfig& config) {
  const CameraSight& sight = view.sight;
  const std::string range = sight.range_m ? fmt::format(" range=\"{:.1f}\"", *sight.range_m) : "";
  const std::string detail = fmt::format(
      "<contact callsign=\"{}\"/><sensor type=\"r-e\" model=\"geoloc\" azimuth=\"{:.2f}\" "
      "elevation=\"{:.2f}\" "
      "roll=\"{:.2f}\" fov=\"{:.2f}\" vfov=\"{:.2f}\"{}/>",
      escape_markup(config.uid_prefix), sight.azimuth_deg, sight.elevation_deg, sight.roll_deg,
      sight.horizontal_view_deg, sight.vertical_view_deg, range);
  const double hae_m =
      context.home_ellipsoid_m ? *context.home_ellipsoid_m + view.vehicle_in_enu.z() : kCotUnknown;
  return event(uid_of_vehicle(context), config.vehicle_type, view.vehicle, hae_m, detail, context, config);
}

std::string point_of_interest_to_cot(const ViewReport& view, const CotViewContext& context,
                                     const CotConfig& config) {
  if (!view.image_centre) return {};
  const std::string detail =
      fmt::format("<contact callsign=\"{} SPI\"/><link uid=\"{}\" type=\"{}\" relation=\"p-p\"/>",
                  escape_markup(config.uid_prefix), uid_of_vehicle(context), config.vehicle_type);
  return event(escape_markup(context.uid + ".spi"), "b-m-p-s-p-i", view.image_centre->position, kCotUnknown,
               detail, context, config);
}

}  // namespace geoloc::io
