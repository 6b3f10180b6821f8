// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/json/detection_fields.hpp"

namespace geoloc::io {

nlohmann::ordered_json detection_to_json(const Detection& detection) {
  const Box& box = detection.box;
  nlohmann::ordered_json json{{"box", {box.x, box.y, box.width, box.height}},
                              {"confidence", detection.confidence},
                              {"class_id", detection.class_id}};
  if (detection.sigma_px > 0.0) json["sigma_px"] = detection.sigma_px;
  return json;
}

}  // namespace geoloc::io
