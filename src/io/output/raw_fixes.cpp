// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/raw_fixes.hpp"

#include <fmt/format.h>

#include <iterator>

#include "geoloc/io/output/decimals.hpp"
#include "geoloc/io/output/object_report.hpp"

namespace geoloc::io {

namespace {

/// "x,y", or "," without a pixel.
std::string two_fields(const std::optional<Eigen::Vector2d>& pixel) {
  return pixel ? fmt::format("{:.2f},{:.2f}", decimals(pixel->x(), 2), decimals(pixel->y(), 2)) : ",";
}

}  // namespace

std::optional<Eigen::Vector2d> innovation_px(const Look& look, const Detection& detection) {
  if (!look.expected_px) return std::nullopt;
  return detection.box.centre() - *look.expected_px;
}

std::string raw_fixes_to_csv(const std::vector<RawFix>& fixes, const LocalFrame& frame) {
  std::string csv =
      "time,latitude_deg,longitude_deg,east_m,north_m,range_m,class_id,confidence,box_x,box_y,box_width,box_"
      "height,frame,object_id,expected_x_px,expected_y_px,innovation_x_px,innovation_y_px\n";
  for (const RawFix& fix : fixes) {
    const Geodetic position = frame.to_geodetic(fix.position_in_enu);
    const Box& box = fix.detection.box;
    fmt::format_to(
        std::back_inserter(csv),
        "{},{:.9f},{:.9f},{:.3f},{:.3f},{:.3f},{},{:.4f},{:.2f},{:.2f},{:.2f},{:.2f},{},{},{},{}\n",
        iso8601(fix.captured_at), position.latitude_deg, position.longitude_deg,
        decimals(fix.position_in_enu.x(), 3), decimals(fix.position_in_enu.y(), 3), fix.range_m,
        fix.detection.class_id, fix.detection.confidence, box.x, box.y, box.width, box.height, fix.frame,
        fix.look.object_id ? std::to_string(*fix.look.object_id) : "", two_fields(fix.look.expected_px),
        two_fields(innovation_px(fix.look, fix.detection)));
  }
  return csv;
}

}  // namespace geoloc::io
