// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/io/detection/detection_config.hpp"
#include "settings/rules.hpp"

namespace geoloc {

template <>
struct EnumNames<io::Backend> {
  static constexpr std::array<std::pair<io::Backend, const char*>, 2> all{
      {{io::Backend::kOpencv, "opencv"}, {io::Backend::kOpenvino, "openvino"}}};
};

template <>
struct EnumNames<io::OutputLayout> {
  static constexpr std::array<std::pair<io::OutputLayout, const char*>, 10> all{
      {{io::OutputLayout::kAuto, "auto"},
       {io::OutputLayout::kYolo11, "yolo11"},
       {io::OutputLayout::kObb, "obb"},
       {io::OutputLayout::kSegment, "segment"},
       {io::OutputLayout::kPose, "pose"},
       {io::OutputLayout::kEnd2end, "end2end"},
       {io::OutputLayout::kRtdetr, "rtdetr"},
       {io::OutputLayout::kRtdetrTop, "rtdetr_top"},
       {io::OutputLayout::kYolov5, "yolov5"},
       {io::OutputLayout::kYolox, "yolox"}}};
};

namespace io {

template <class Visitor>
void visit_fields(Visitor& v, SecondLookConfig& second_look) {
  v.field("confidence", second_look.confidence, Range::open(0, 1), "",
          "Boxes of at least this score are looked at once more, by models that have a network for it");
  v.field("max_boxes", second_look.max_boxes, Range::closed(1, 1000), "",
          "Most boxes per picture that are looked at once more, the most confident ones");
}

template <class Visitor>
void visit_fields(Visitor& v, DetectionConfig& detection) {
  constexpr Range kInput = Range::closed(0, kLongestInput_px);
  constexpr Range kTiles = Range::closed(1, 32);
  v.field("confidence", detection.confidence, Range::below(0, 1), "",
          "Boxes of a lower score are dropped; 0: the model's own threshold, 0.8 for models made for geoloc "
          "and 0.25 for all others");
  v.field(
      "nms_iou", detection.nms_iou, Range::above(0, 1), "",
      "Of two boxes of a class that overlap by more (intersection over union), the more confident one stays");
  v.field("max_detections", detection.max_detections, Range::closed(1, 10000), "",
          "Most detections per picture");
  v.field("threads", detection.threads, Range::closed(0, 256), "",
          "Threads of the back end (OpenCV's are the whole program's); 0: one per core");
  v.field("backend", detection.backend, Any{}, "", "What runs the network; openvino where it was built in");
  v.field("layout", detection.layout, Any{}, "",
          "How the network's output lists its boxes; auto: as its metadata and shape tell");
  v.field("input_width_px", detection.input_width_px, kInput, "px",
          "Width of the network's input, for models that leave it open; 0: the model's own");
  v.field("input_height_px", detection.input_height_px, kInput, "px", "Its height; give both or none");
  v.relation("input_width_px", detection.input_width_px,
             (detection.input_width_px == 0) == (detection.input_height_px == 0),
             "must be given together with input_height_px, or neither");
  v.field("tile_columns", detection.tile_columns, kTiles, "",
          "Tiles side by side into which a picture is cut, each searched besides the whole; 1 x 1: it is not "
          "cut");
  v.field("tile_rows", detection.tile_rows, kTiles, "", "Tiles one below the other");
  v.field("tile_overlap_px", detection.tile_overlap_px, Range::closed(0, 4096), "px",
          "Overlap of neighbouring tiles in the picture: no less than the length of the objects to be found "
          "in them");
  v.section("second_look", detection.second_look);
}

}  // namespace io
}  // namespace geoloc
