// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/io/detection/detection_config.hpp"
#include "geoloc/io/detection/letterbox.hpp"

namespace geoloc::io {

/// What a model's file and a first run tell of the output that lists its boxes.
struct OutputFacts {
  std::vector<std::int64_t> shape;
  std::optional<int> classes;  ///< that have names
  std::string task;            ///< ultralytics' metadata: detect, obb, segment …; empty where unstated
  std::optional<bool> has_selected;  ///< likewise: whether the network itself chose the best boxes
  std::optional<bool> is_rtdetr;     ///< likewise
  int mask_coefficients = 0;         ///< of each box: the channels of another output, the masks' prototypes
  ImageSize input;
};

/// Where a candidate's numbers are and what they mean, with C classes and N candidates:
///
///   yolo11      [1, 4 + C, N]      cx cy w h, a score per class           YOLOv8, 11, 12; YOLO26 as exported
///   obb         [1, 4 + C + 1, N]  the same, angle [rad] of the box
///   segment     [1, 4 + C + M, N]  the same, M mask coefficients
///   pose        [1, 4 + C + K, N]  the same, K numbers of key points
///   end2end     [1, N, 6 + E]      x1 y1 x2 y2, score, class; E numbers as of obb, segment or pose. For obb,
///                                  cx cy w h precede in place of corners
///   rtdetr      [1, N, 4 + C]      cx cy w h as shares of the input, a score per class
///   rtdetr_top  [1, N, 6]          cx cy w h likewise, score, class
///   yolov5      [1, N, 5 + C]      cx cy w h, score of any object, a score per class given one
///   yolox       [1, N, 5 + C]      the same, relative to the cell of a grid, for a picture in BGR from 0 to
///   255
///
/// Lengths are pixels of the network's input with continuous edges, scores lie in 0..1.
struct OutputForm {
  OutputLayout layout = OutputLayout::kYolo11;  ///< never kAuto
  int classes = 0;
  int candidates = 0;
  int values = 0;           ///< per candidate
  bool is_rotated = false;  ///< the last value is the box's angle [rad]

  friend bool operator==(const OutputForm& a, const OutputForm& b) {
    return a.layout == b.layout && a.classes == b.classes && a.candidates == b.candidates &&
           a.values == b.values && a.is_rotated == b.is_rotated;
  }
};

/// Every form that the output may have. With `wanted`, the configuration's, only that layout is considered,
/// and what metadata say of the task does not matter. Takes any facts.
std::vector<OutputForm> possible_forms(const OutputFacts& facts, OutputLayout wanted);

/// Whether the output holds each of a candidate's numbers for all candidates in a row: [1, values,
/// candidates].
bool lists_candidates_last(OutputLayout layout);

/// Whether the network itself has chosen the best boxes, so that none is to be suppressed: also RT-DETR,
/// which is trained to give each object once.
bool needs_no_suppression(OutputLayout layout);

/// "[1, 4 + classes, candidates]": for messages.
const char* shape_of(OutputLayout layout);

/// Between the cells of the grids that YOLO networks predict boxes in.
inline constexpr std::array kGridStrides_px{8, 16, 32};

/// The cells of all these grids.
std::int64_t grid_cells(ImageSize input);

}  // namespace geoloc::io
