// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "geoloc/camera/detection.hpp"
#include "geoloc/geometry/geodetic.hpp"

namespace geoloc::io {

/// Where a mark of a survey is, as a list of ground control points has it.
struct SurveyedMark {
  std::string name;
  Geodetic position;
  double height_m = 0.0;  ///< in the survey's datum
};

/// What people marked in pictures, or a detector found before.
struct Labels {
  /// By the picture's file name, without its folder, in small letters. A picture with an empty list was
  /// looked at in vain.
  std::map<std::string, std::vector<Detection>> by_picture;
  std::vector<SurveyedMark> marks;       ///< each once; empty where the labels are of no survey
  std::vector<std::string> class_names;  ///< by class id; empty where the labels have none
};

/// OpenDroneMap's gcp_list.txt (a line with the coordinate system, then `x y z u v picture [name]` a line),
/// CSV whose first line names its columns: `picture,u,v[,width,height,class_id,confidence]`, or the JSON
/// Lines of geoloc_detect. u and v are OpenCV's pixels: the centre of the top left one is 0, 0. Throws
/// std::runtime_error with `name`, line and reason.
Labels parse_labels(const std::string& text, const std::string& name);

/// The key of Labels::by_picture for a file.
std::string label_key(const std::string& file_name);

}  // namespace geoloc::io
