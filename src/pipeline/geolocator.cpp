// SPDX-License-Identifier: Apache-2.0
#include "geoloc/pipeline/geolocator.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "geoloc/geometry/problems.hpp"

namespace geoloc {
namespace {

GeolocatorConfig checked(const GeolocatorConfig& config) {
  throw_if_any(config.problems());
  return config;
}

bool is_usable(const Detection& detection) {
  const Box& box = detection.box;
  return std::isfinite(box.x) && std::isfinite(box.y) && box.width > 0.0 && std::isfinite(box.width) &&
         box.height > 0.0 && std::isfinite(box.height) && std::isfinite(detection.confidence);
}

/// Total order on what a detection is: whatever order a detector lists them in, they are treated alike.
bool canonical_order(const Detection& a, const Detection& b) {
  const auto key = [](const Detection& d) {
    return std::make_tuple(-d.confidence, d.box.x, d.box.y, d.box.width, d.box.height, d.class_id);
  };
  return key(a) < key(b);
}

}  // namespace

std::vector<std::string> GeolocatorConfig::problems() const {
  Problems found;
  found.require(max_detections >= 1 && max_detections <= 10000, "max_detections must lie in [1, 10000]");
  found.add(camera.problems());
  found.add(state.problems());
  found.add(projector.problems());
  found.add(paper.problems());
  return found.take();
}

Geolocator::Geolocator(const GeolocatorConfig& config)
    : config_(checked(config)),
      state_(config.state),
      projector_(config.projector, config.camera.intrinsics),
      tracker_(config.paper, config.max_detections) {
  selected_.reserve(static_cast<std::size_t>(config.max_detections));
  located_.reserve(static_cast<std::size_t>(config.max_detections));
}

std::optional<NoState> Geolocator::missing_state(VehicleTime captured_at) const {
  const auto state = state_.at(captured_at);
  if (state) return std::nullopt;
  return state.error();
}

bool Geolocator::process(const FrameDetections& frame) {
  ++counters_.frames;
  const auto vehicle = state_.at(frame.captured_at);
  if (!vehicle) {
    ++counters_.frames_unusable;
    return false;
  }
  ++counters_.frames_located;
  vehicle_ = *vehicle;
  enu_from_camera_ = geoloc::enu_from_camera(vehicle_, config_.camera.mount, config_.camera_orientation);
  select(frame.detections);
  locate();
  tracker_.update(located_, projector_, enu_from_camera_, frame.captured_at_host);
  return true;
}

void Geolocator::select(const std::vector<Detection>& detections) {
  selected_.clear();
  const auto most = static_cast<std::size_t>(config_.max_detections);
  for (const Detection& detection : detections) {
    if (!is_usable(detection)) {
      ++counters_.detections_dropped;
    } else if (selected_.size() < most) {
      selected_.push_back(detection);
    } else {
      ++counters_.detections_dropped;
      const auto last = std::max_element(selected_.begin(), selected_.end(), canonical_order);
      if (canonical_order(detection, *last)) *last = detection;
    }
  }
  std::sort(selected_.begin(), selected_.end(), canonical_order);
  counters_.detections += selected_.size();
}

void Geolocator::locate() {
  located_.clear();
  for (const Detection& detection : selected_) {
    const auto fix = projector_.project(detection.box.centre(), enu_from_camera_);
    if (fix) {
      located_.push_back({detection, *fix});
    } else {
      ++counters_.no_fix[static_cast<std::size_t>(fix.error())];
    }
  }
}

}  // namespace geoloc
