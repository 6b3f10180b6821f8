// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/raw_fixes.hpp"

#include <fmt/format.h>

#include <iterator>

#include "geoloc/io/output/object_report.hpp"

namespace geoloc::io {

std::string raw_fixes_to_csv(const std::vector<RawFix>& fixes, const LocalFrame& frame) {
  std::string csv =
      "time,latitude_deg,longitude_deg,east_m,north_m,range_m,class_id,confidence,box_x,box_y,box_width,box_"
      "height\n";
  for (const RawFix& fix : fixes) {
    const Geodetic position = frame.to_geodetic(fix.position_in_enu);
    const Box& box = fix.detection.box;
    fmt::format_to(std::back_inserter(csv),
                   "{},{:.9f},{:.9f},{:.3f},{:.3f},{:.3f},{},{:.4f},{:.2f},{:.2f},{:.2f},{:.2f}\n",
                   iso8601(fix.captured_at), position.latitude_deg, position.longitude_deg,
                   fix.position_in_enu.x(), fix.position_in_enu.y(), fix.range_m, fix.detection.class_id,
                   fix.detection.confidence, box.x, box.y, box.width, box.height);
  }
  return csv;
}

}  // namespace geoloc::io
