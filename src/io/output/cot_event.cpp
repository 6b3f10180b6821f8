// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/cot_event.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geoloc/io/output/circular_error.hpp"
#include "geoloc/io/output/markup.hpp"
#include "geoloc/io/output/text.hpp"

namespace geoloc::io {
namespace {

constexpr std::size_t kLongestName = 32;

double known_or(double value, double otherwise) {
  return std::isfinite(value) ? value : otherwise;
}

std::string type_of(const ObjectReport& object, const CotConfig& config) {
  const auto found = config.types.find(object.class_name);
  return found != config.types.end() ? found->second : config.type;
}

std::string remarks(const ObjectReport& object, bool is_gone) {
  std::string text = is_gone ? "retracted, " : "";
  text += fmt::format("confidence {:.3f}, {} looks, 1 sigma {:.2f} m x {:.2f} m towards {:.0f} deg",
                      object.confidence, object.hits, object.ellipse.sigma_major_m,
                      object.ellipse.sigma_minor_m, object.ellipse.azimuth_deg);
  if (object.height.msl_m && std::isfinite(*object.height.msl_m))
    text += fmt::format(", {:.1f} m above mean sea level", *object.height.msl_m);
  return text;
}

/// The <track> element; empty for objects that stand still.
std::string track_of(const ObjectReport& object) {
  if (!object.course) return {};
  return fmt::format("<track course=\"{:.1f}\" speed=\"{:.2f}\"/>",
                     known_or(object.course->direction_deg, 0.0), known_or(object.course->speed_mps, 0.0));
}

}  // namespace

std::string to_cot(const ObjectReport& object, const CotContext& context, const CotConfig& config) {
  const double p = config.error_probability;
  const double ce = circular_error(object.ellipse.sigma_major_m, object.ellipse.sigma_minor_m, p);
  const double sigma_height_m = std::hypot(config.sigma_height_m, object.height.sigma_m.value_or(0.0));
  const double le = object.height.ellipsoid_m ? circular_error(sigma_height_m, 0.0, p) : kCotUnknown;
  const std::string name = escape_markup(clean_text(object.class_name, kLongestName));
  const HostTime stale_at =
      context.sent_at + (context.is_gone ? Duration::zero() : from_seconds(config.stale_s));
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\"?>\n"
      "<event version=\"2.0\" uid=\"{}\" type=\"{}\" how=\"m-f\" time=\"{}\" start=\"{}\" stale=\"{}\">"
      "<point lat=\"{:.8f}\" lon=\"{:.8f}\" hae=\"{:.2f}\" ce=\"{:.2f}\" le=\"{:.2f}\"/>"
      "<detail><contact callsign=\"{} {}\"/><precisionlocation geopointsrc=\"Calculated\" altsrc=\"{}\"/>{}"
      "<remarks>{}</remarks></detail></event>\n",
      escape_markup(context.uid), type_of(object, config), iso8601(context.sent_at),
      iso8601(std::min(object.last_seen, context.sent_at)), iso8601(stale_at), object.position.latitude_deg,
      object.position.longitude_deg, known_or(object.height.ellipsoid_m.value_or(kCotUnknown), kCotUnknown),
      known_or(ce, kCotUnknown), known_or(le, kCotUnknown), name, object.id,
      object.height.ellipsoid_m ? "Calculated" : "???", track_of(object), remarks(object, context.is_gone));
}

}  // namespace geoloc::io
