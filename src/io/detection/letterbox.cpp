// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/detection/letterbox.hpp"

#include <algorithm>
#include <cmath>

namespace geoloc::io {
namespace {

int scaled_length(int length_px, double scale, int limit_px) {
  return std::clamp(static_cast<int>(std::nearbyint(length_px * scale)), 1, limit_px);
}

}  // namespace

Letterbox fit_letterbox(ImageSize picture, ImageSize input) {
  const double scale = std::min(static_cast<double>(input.width_px) / picture.width_px,
                                static_cast<double>(input.height_px) / picture.height_px);
  Letterbox letterbox;
  letterbox.scaled = {scaled_length(picture.width_px, scale, input.width_px),
                      scaled_length(picture.height_px, scale, input.height_px)};
  letterbox.left_px = (input.width_px - letterbox.scaled.width_px) / 2;
  letterbox.top_px = (input.height_px - letterbox.scaled.height_px) / 2;
  letterbox.scale_x = static_cast<double>(letterbox.scaled.width_px) / picture.width_px;
  letterbox.scale_y = static_cast<double>(letterbox.scaled.height_px) / picture.height_px;
  return letterbox;
}

Letterbox stretch_to(ImageSize picture, ImageSize input) {
  Letterbox letterbox;
  letterbox.scaled = input;
  letterbox.scale_x = static_cast<double>(input.width_px) / picture.width_px;
  letterbox.scale_y = static_cast<double>(input.height_px) / picture.height_px;
  return letterbox;
}

Box Letterbox::to_input(const Box& in_picture) const {
  return {in_picture.x * scale_x + left_px, in_picture.y * scale_y + top_px, in_picture.width * scale_x,
          in_picture.height * scale_y};
}

Box Letterbox::to_picture(const Box& in_input) const {
  return {(in_input.x - left_px) / scale_x, (in_input.y - top_px) / scale_y, in_input.width / scale_x,
          in_input.height / scale_y};
}

}  // namespace geoloc::io
