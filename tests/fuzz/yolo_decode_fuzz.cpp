// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "geoloc/io/detection/yolo_decode.hpp"

namespace {

using namespace geoloc;

constexpr io::ImageSize kInput{640, 384};

void require_inside(const Box& box, io::ImageSize picture) {
  const bool is_inside = box.x >= 0 && box.y >= 0 && box.width > 0 && box.height > 0 &&
                         box.x + box.width <= picture.width_px + 1e-6 &&
                         box.y + box.height <= picture.height_px + 1e-6;
  if (!is_inside) std::abort();
}

/// The facts of any shape, whose lengths need not be those of a network.
io::OutputFacts facts_of(const std::uint8_t* data) {
  constexpr const char* kTasks[] = {"", "detect", "obb", "segment", "pose", "classify"};
  constexpr std::int64_t kLengths[] = {-1, 0, 1, 5, 6, 7, 38, 84, 300, 8400, 25200, std::int64_t{1} << 62};
  io::OutputFacts facts;
  for (int i = 0; i < data[0] % 5; ++i) facts.shape.push_back(kLengths[data[1 + i] % 12]);
  if (data[5] % 2 == 1) facts.classes = data[6] - 100;
  if (data[5] % 4 == 3) facts.has_selected = data[5] % 8 == 7;
  facts.task = kTasks[data[7] % 6];
  facts.mask_coefficients = data[6] % 3 == 0 ? 32 : 0;
  facts.input = kInput;
  return facts;
}

/// What is recognized fits the output.
void require_sound_forms(const io::OutputFacts& facts, io::OutputLayout wanted) {
  for (const io::OutputForm& form : io::possible_forms(facts, wanted)) {
    const auto lengths = static_cast<std::int64_t>(form.candidates) * form.values;
    if (lengths != facts.shape[1] * facts.shape[2] || form.candidates < 1 || form.values < 5) std::abort();
    if (form.layout == io::OutputLayout::kAuto || form.values < 4 + (form.is_rotated ? 1 : 0)) std::abort();
  }
}

/// As many candidates as there are numbers for.
io::OutputForm form_of(std::uint8_t layout, int classes, std::size_t numbers) {
  io::OutputForm form;
  form.layout = static_cast<io::OutputLayout>(1 + layout % 9);
  form.classes = classes;
  form.is_rotated =
      form.layout == io::OutputLayout::kObb || (form.layout == io::OutputLayout::kEnd2end && layout > 127);
  const bool has_class =
      form.layout == io::OutputLayout::kEnd2end || form.layout == io::OutputLayout::kRtdetrTop;
  form.values = (has_class ? 6 : 5 + classes) + (form.is_rotated ? 1 : 0);
  form.candidates = static_cast<int>(numbers) / form.values;
  if (form.layout == io::OutputLayout::kYolox)
    form.candidates = std::min(form.candidates, static_cast<int>(io::grid_cells(kInput)));
  return form;
}

}  // namespace

/// Any shape as that of an output, and any numbers as the output of a network of any layout.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kHead = 12;
  if (size < kHead) return 0;
  require_sound_forms(facts_of(data + 4), static_cast<io::OutputLayout>(data[3] % 10));
  const int classes = 1 + data[0] % 4;
  const io::ImageSize picture{1 + data[1] * 16, 1 + data[2] * 16};
  std::vector<float> values((size - kHead) / sizeof(float));
  if (!values.empty()) std::memcpy(values.data(), data + kHead, values.size() * sizeof(float));
  const io::OutputForm form = form_of(data[3], classes, values.size());
  io::DetectionConfig config;
  config.confidence = 0.25;
  const auto decoded = io::decode_yolo({values.data(), form}, io::fit_letterbox(picture, kInput), kInput,
                                       picture, config, io::CentreSigma{0.3, 0.01});
  if (decoded.detections.size() > static_cast<std::size_t>(config.max_detections)) std::abort();
  for (const Detection& detection : decoded.detections) {
    require_inside(detection.box, picture);
    if (detection.sigma_px != 0.0 && !is_sigma_px(detection.sigma_px)) std::abort();
    if (!(detection.confidence > 0 && detection.confidence <= 1)) std::abort();
    if (detection.class_id < 0 || detection.class_id >= classes) std::abort();
  }
  return 0;
}
