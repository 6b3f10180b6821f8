// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/json/detection_fields.hpp"

#include <cmath>
#include <stdexcept>

#include "io/json/plain_values.hpp"

namespace geoloc::io {
namespace {

// Far beyond any real frame; keeps sums of coordinates finite and exact enough.
constexpr double kLargestPixel = 1e6;

Box parse_box(const nlohmann::json& value) {
  if (!value.is_array() || value.size() != 4)
    throw std::invalid_argument("box must be [x, y, width, height]");
  Box box{finite_number(value[0], "box[0]"), finite_number(value[1], "box[1]"),
          finite_number(value[2], "box[2]"), finite_number(value[3], "box[3]")};
  if (!(box.width > 0.0 && box.height > 0.0)) throw std::invalid_argument("box has no size");
  for (const double edge : {box.x, box.y, box.width, box.height}) {
    if (std::abs(edge) > kLargestPixel) throw std::invalid_argument("box lies beyond any image");
  }
  return box;
}

}  // namespace

nlohmann::ordered_json detection_to_json(const Detection& detection) {
  const Box& box = detection.box;
  nlohmann::ordered_json json{{"box", {box.x, box.y, box.width, box.height}},
                              {"confidence", detection.confidence},
                              {"class_id", detection.class_id}};
  if (detection.sigma_px > 0.0) json["sigma_px"] = detection.sigma_px;
  return json;
}

Detection detection_from_json(const nlohmann::json& value) {
  if (!value.is_object()) throw std::invalid_argument("a detection must be an object");
  Detection detection;
  detection.box = parse_box(member(value, "box"));
  detection.confidence =
      value.contains("confidence") ? finite_number(value["confidence"], "confidence") : 1.0;
  if (!(detection.confidence >= 0.0 && detection.confidence <= 1.0)) {
    throw std::invalid_argument("confidence must lie in [0, 1]");
  }
  if (value.contains("class_id")) detection.class_id = whole_number(value["class_id"], "class_id", 1e6);
  if (value.contains("sigma_px")) {
    detection.sigma_px = finite_number(value["sigma_px"], "sigma_px");
    if (!is_sigma_px(detection.sigma_px))
      throw std::invalid_argument("sigma_px must lie in [0.001, 1000]; leave it out where it is not known");
  }
  return detection;
}

}  // namespace geoloc::io
