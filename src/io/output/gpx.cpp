// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/gpx.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "geoloc/io/output/markup.hpp"

namespace geoloc::io {
namespace {

/// What a receiver's small display is to say besides the name.
std::string description(const ObjectReport& object) {
  std::string text = object.class_name;
  if (object.note.verdict != Verdict::kNone) text += std::string(", ") + word_of(object.note.verdict);
  if (std::isfinite(object.ellipse.sigma_major_m))
    text += fmt::format(", sigma {:.2f} m", object.ellipse.sigma_major_m);
  return text + fmt::format(", {} looks", object.hits);
}

void write_waypoint(const ObjectReport& object, std::string& gpx) {
  const auto out = std::back_inserter(gpx);
  fmt::format_to(out, "<wpt lat=\"{:.9f}\" lon=\"{:.9f}\">", object.position.latitude_deg,
                 object.position.longitude_deg);
  if (object.height.msl_m && std::isfinite(*object.height.msl_m))
    fmt::format_to(out, "<ele>{:.2f}</ele>", *object.height.msl_m);
  const std::string& called = object.note.name.empty() ? object.class_name : object.note.name;
  fmt::format_to(out, "<time>{}</time><name>{} {}</name><desc>{}</desc><type>{}</type></wpt>\n",
                 iso8601(object.last_seen), escape_markup(called), object.id,
                 escape_markup(description(object)), escape_markup(object.class_name));
}

void write_track(const RunRecord& run, std::string& gpx) {
  if (!run.local_frame || run.trajectory.empty()) return;
  gpx += "<trk><name>trajectory</name><trkseg>\n";
  for (const TrajectoryPoint& point : run.trajectory) {
    if (!point.position_in_enu.allFinite()) continue;
    const Geodetic place = run.local_frame->to_geodetic(point.position_in_enu.head<2>());
    fmt::format_to(std::back_inserter(gpx), "<trkpt lat=\"{:.9f}\" lon=\"{:.9f}\"><time>{}</time></trkpt>\n",
                   place.latitude_deg, place.longitude_deg, iso8601(point.at));
  }
  gpx += "</trkseg></trk>\n";
}

}  // namespace

std::string run_to_gpx(const RunRecord& run) {
  std::string gpx =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<gpx version=\"1.1\" creator=\"geoloc\" "
      "xmlns=\"http://www.topografix.com/GPX/1/1\">\n<metadata><name>" +
      escape_markup(run.title) + "</name></metadata>\n";
  for (const ObjectReport& object : run.objects) {
    if (has_place(object)) write_waypoint(object, gpx);
  }
  write_track(run, gpx);
  return gpx + "</gpx>\n";
}

}  // namespace geoloc::io
