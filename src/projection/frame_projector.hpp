// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "geoloc/projection/projector.hpp"
#include "geometry/lanes.hpp"

namespace geoloc {

/// The pixels of one frame to level ground, several at once (paper, eq. 7-10): number for number what
/// Projector::project() gives for each, in a fraction of the time.
class FrameProjector {
 public:
  FrameProjector(const Projector& projector, const Rigid3d& enu_from_camera);
  FrameProjector(const Projector& projector, const FrameView& from);

  /// Calls take(i, Expected<GroundFix, NoFix>) for each i < count; pixel_of(i) is [px].
  template <typename PixelOf, typename Take>
  void project(std::size_t count, const PixelOf& pixel_of, const Take& take) const {
    for (std::size_t begin = 0; begin < count; begin += kLanes) {
      const std::size_t end = std::min(begin + kLanes, count);
      Lanes u_px, v_px;
      for (std::size_t i = begin; i < begin + kLanes; ++i) {
        const Eigen::Vector2d pixel = pixel_of(std::min(i, end - 1));
        u_px[static_cast<Eigen::Index>(i - begin)] = pixel.x();
        v_px[static_cast<Eigen::Index>(i - begin)] = pixel.y();
      }
      const Fixes fixes = fixes_of(u_px, v_px);
      for (std::size_t i = begin; i < end; ++i) take(i, fixes.of(static_cast<int>(i - begin)));
    }
  }

 private:
  /// Fixes of several pixels (GroundFix).
  struct Fixes {
    Lanes east, north;
    Lanes east_by_u, east_by_v, north_by_u, north_by_v;
    Lanes direction_east, direction_north, direction_up;
    Lanes range_m;
    std::array<std::optional<NoFix>, kLanes> none;

    Expected<GroundFix, NoFix> of(int lane) const;
  };

  Fixes fixes_of(const Lanes& u_px, const Lanes& v_px) const;

  const Projector& projector_;
  CameraModel camera_;
  Eigen::Vector3d camera_in_enu_;
  Eigen::Matrix3d enu_from_camera_;
  bool is_finite_;
};

}  // namespace geoloc
