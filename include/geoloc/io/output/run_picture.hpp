// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "geoloc/io/output/object_report.hpp"
#include "geoloc/io/output/run_record.hpp"

namespace geoloc::io {

/// What the picture of a run shows (the paper's figures 8-10). East, north [m] throughout.
struct RunPicture {
  std::string title;
  std::string subtitle;
  std::vector<Eigen::Vector2d> targets;  ///< true positions; may be empty
  std::vector<Eigen::Vector2d> raw_fixes;
  std::vector<Eigen::Vector2d> trajectory;
  std::vector<ObjectReport> objects;
};

RunPicture picture_of(const RunRecord& run);

/// A self-contained SVG document: metric grid, trajectory, raw fixes, targets, objects with 2-sigma ellipses,
/// legend. Texts are escaped. What is not finite is left out.
std::string to_svg(const RunPicture& picture);

}  // namespace geoloc::io
