// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "geoloc/io/detection/yolo_decode.hpp"

namespace {

using namespace geoloc;

void require_inside(const Box& box, io::ImageSize picture) {
  const bool is_inside = box.x >= 0 && box.y >= 0 && box.width > 0 && box.height > 0 &&
                         box.x + box.width <= picture.width_px + 1e-6 &&
                         box.y + box.height <= picture.height_px + 1e-6;
  if (!is_inside) std::abort();
}

}  // namespace

/// Any numbers as the output of a network with one to four classes.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 8) return 0;
  const int classes = 1 + data[0] % 4;
  const io::ImageSize picture{1 + data[1] * 16, 1 + data[2] * 16};
  const io::ImageSize input{640, 384};
  std::vector<float> values((size - 4) / sizeof(float));
  std::memcpy(values.data(), data + 4, values.size() * sizeof(float));
  const int candidates = static_cast<int>(values.size()) / (4 + classes);
  const auto decoded =
      io::decode_yolo({values.data(), classes, candidates}, io::fit_letterbox(picture, input), picture, {},
                      io::CentreSigma{0.3, 0.01});
  for (const Detection& detection : decoded.detections) {
    require_inside(detection.box, picture);
    if (detection.sigma_px != 0.0 && !is_sigma_px(detection.sigma_px)) std::abort();
    if (!(detection.confidence > 0 && detection.confidence <= 1)) std::abort();
    if (detection.class_id < 0 || detection.class_id >= classes) std::abort();
  }
  return 0;
}
