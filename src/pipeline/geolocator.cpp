// SPDX-License-Identifier: Apache-2.0
#include "geoloc/pipeline/geolocator.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "geoloc/geometry/problems.hpp"
#include "pipeline/geolocator_fields.hpp"
#include "settings/field_checker.hpp"

namespace geoloc {
namespace {

GeolocatorConfig checked(const GeolocatorConfig& config) {
  throw_if_any(config.problems());
  return config;
}

bool is_usable(const Detection& detection) {
  const Box& box = detection.box;
  return std::isfinite(box.x) && std::isfinite(box.y) && box.width > 0.0 && std::isfinite(box.width) &&
         box.height > 0.0 && std::isfinite(box.height) && std::isfinite(detection.confidence) &&
         (detection.sigma_px == 0.0 || is_sigma_px(detection.sigma_px));
}

std::variant<PaperTracker, JointTracker> make_tracker(const GeolocatorConfig& config) {
  if (config.method == Method::kPaper) return PaperTracker(config.paper, config.max_detections);
  return JointTracker(config.joint, config.known_points, config.max_detections);
}

bool may_be_cut(const Box& box, const CameraIntrinsics& image, double margin_px) {
  return box.x < margin_px || box.y < margin_px || box.x + box.width > image.width_px - margin_px ||
         box.y + box.height > image.height_px - margin_px;
}

/// Total order on what a detection is: whatever order a detector lists them in, they are treated alike.
bool canonical_order(const Detection& a, const Detection& b) {
  const auto key = [](const Detection& d) {
    return std::make_tuple(-d.confidence, d.box.x, d.box.y, d.box.width, d.box.height, d.class_id,
                           d.sigma_px);
  };
  return key(a) < key(b);
}

}  // namespace

std::vector<std::string> GeolocatorConfig::problems() const {
  return check_fields(*this);
}

Geolocator::Geolocator(const GeolocatorConfig& config)
    : config_(checked(config)),
      state_(config.state),
      projector_(config.projector, config.camera.intrinsics),
      tracker_(make_tracker(config)) {
  selected_.reserve(static_cast<std::size_t>(config.max_detections));
  located_.reserve(static_cast<std::size_t>(config.max_detections));
}

const std::vector<Track>& Geolocator::tracks() const {
  return std::visit([](const auto& tracker) -> const std::vector<Track>& { return tracker.tracks(); },
                    tracker_);
}

const TrackCounters& Geolocator::track_counters() const {
  return std::visit([](const auto& tracker) -> const TrackCounters& { return tracker.counters(); }, tracker_);
}

std::optional<Calibration> Geolocator::calibration() const {
  const auto* joint = std::get_if<JointTracker>(&tracker_);
  if (joint == nullptr) return std::nullopt;
  return joint->calibration_of_camera();
}

const std::vector<KnownPoints::Entry>& Geolocator::known_points() const {
  static const std::vector<KnownPoints::Entry> none;
  const auto* joint = std::get_if<JointTracker>(&tracker_);
  return joint == nullptr ? none : joint->known_points().entries();
}

Duration Geolocator::latency() const {
  const auto* joint = std::get_if<JointTracker>(&tracker_);
  return joint == nullptr ? Duration::zero() : from_seconds(joint->calibration().latency_s());
}

Rigid3d Geolocator::calibrated_camera_pose(const VehicleState& vehicle) const {
  Rigid3d pose = enu_from_camera(vehicle, config_.camera.mount, config_.camera_orientation);
  if (const auto* joint = std::get_if<JointTracker>(&tracker_)) joint->calibration().apply_to(pose);
  return pose;
}

std::optional<NoState> Geolocator::missing_state(VehicleTime captured_at) const {
  const auto state = state_.at(captured_at - latency());
  if (state) return std::nullopt;
  return state.error();
}

bool Geolocator::process(const FrameDetections& frame) {
  ++counters_.frames;
  const auto vehicle = state_.at(frame.captured_at - latency());
  if (!vehicle) {
    ++counters_.frames_unusable;
    return false;
  }
  ++counters_.frames_located;
  place_known_points();
  view_ = {*vehicle, calibrated_camera_pose(*vehicle), frame.captured_at_host};
  select(frame.detections);
  locate();
  std::visit([&](auto& tracker) { tracker.update(located_, projector_, view_); }, tracker_);
  return true;
}

void Geolocator::place_known_points() {
  auto* joint = std::get_if<JointTracker>(&tracker_);
  if (joint != nullptr && !joint->known_points().is_placed()) joint->set_local_frame(*state_.local_frame());
}

void Geolocator::select(const std::vector<Detection>& detections) {
  selected_.clear();
  const auto most = static_cast<std::size_t>(config_.max_detections);
  for (const Detection& detection : detections) {
    if (!is_usable(detection)) {
      ++counters_.detections_dropped;
    } else if (config_.edge_margin_px > 0.0 &&
               may_be_cut(detection.box, config_.camera.intrinsics, config_.edge_margin_px)) {
      ++counters_.detections_at_edge;
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
    const auto fix = projector_.project(detection.box.centre(), view_.enu_from_camera);
    if (fix) {
      located_.push_back({detection, *fix});
    } else {
      ++counters_.no_fix[static_cast<std::size_t>(fix.error())];
    }
  }
}

}  // namespace geoloc
