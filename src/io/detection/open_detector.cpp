// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "geoloc/geometry/refuse.hpp"
#include "geoloc/io/detection/second_look.hpp"
#include "geoloc/io/detection/tiled_detector.hpp"
#include "geoloc/io/detection/yolo_detector.hpp"
#include "model_file.hpp"

namespace geoloc::io {
namespace {

/// The second-look network: the one configured, or the one that the model names. Empty: none.
std::filesystem::path second_look_file(const DetectorFiles& files) {
  if (files.second_look) return *files.second_look;
  const auto properties = read_model_metadata(files.model).properties;
  const auto entry = properties.find(kSecondLookKey);
  if (entry == properties.end()) return {};
  const std::filesystem::path name = entry->second;
  if (name.empty() || name != name.filename() || name == "." || name == "..")
    refuse_model(files.model,
                 std::string{"its metadata's "} + kSecondLookKey + " is no file's name without a folder");
  std::error_code error;
  const auto beside = files.model.parent_path() / name;
  if (std::filesystem::exists(beside, error)) return beside;
  refuse_model(files.model,
               "needs " + name.string() +
                   " beside it for the second look: put it there, or "
                   "turn the second look off (--second-look none), which gives more false detections");
}

}  // namespace

std::unique_ptr<Detector> open_detector(const DetectorFiles& files, const DetectionConfig& configured) {
  refuse_if_any(configured.problems());
  const DetectionConfig config = with_model_defaults(files, configured);
  const auto second_look = second_look_file(files);
  const DetectionConfig first = second_look.empty() ? config : proposing(config);
  std::unique_ptr<Detector> detector = std::make_unique<YoloDetector>(files, first);
  if (first.tile_columns * first.tile_rows > 1)
    detector = std::make_unique<TiledDetector>(std::move(detector), first);
  if (second_look.empty()) return detector;
  return std::make_unique<SecondLookDetector>(std::move(detector), second_look, config);
}

}  // namespace geoloc::io
