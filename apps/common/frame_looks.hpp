// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "geoloc/io/output/raw_fixes.hpp"
#include "geoloc/pipeline/geolocator.hpp"

namespace geoloc::apps {

/// Where an object is in the frame located last. The view is lifted (FrameView), and objects with it.
Eigen::Vector3d position_in_view(const Track& object, const Geolocator& geolocator);

/// What became of each detection of a frame: which object it is taken to show, and where that object was
/// expected. The estimator tells which objects a frame showed; each of these is paired with the detection
/// that is nearest to it in the image, all at least total distance.
class FrameLooks {
 public:
  /// Before the Geolocator gets the frame: remembers what it expects.
  void expect(const Geolocator& geolocator) { expected_ = geolocator.tracks(); }

  /// After it has located the frame: one entry for each of Geolocator::located().
  std::vector<io::Look> looks(const Geolocator& geolocator, HostTime captured_at) const;

 private:
  std::vector<Track> expected_;
};

}  // namespace geoloc::apps
