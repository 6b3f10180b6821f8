// SPDX-License-Identifier: Apache-2.0
#include "geoloc/pipeline/geolocator.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "geoloc/geometry/problems.hpp"
#include "geoloc/projection/ground_model.hpp"
#include "geoloc/projection/projector.hpp"
#include "geoloc/state/state_buffer.hpp"
#include "geoloc/state/state_provider.hpp"
#include "pipeline/geolocator_fields.hpp"
#include "projection/frame_viewer.hpp"
#include "settings/field_checker.hpp"
#include "tracking/joint_tracker.hpp"
#include "tracking/paper_tracker.hpp"

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

std::unique_ptr<Tracker> make_tracker(const GeolocatorConfig& config) {
  if (config.method == Method::kPaper)
    return std::make_unique<PaperTracker>(config.paper, config.max_detections);
  return std::make_unique<JointTracker>(config.joint, config.known_points, config.max_detections);
}

/// What cannot be a sigma is as good as none.
double usable_sigma(double time_sigma_s) {
  return time_sigma_s > 0.0 && time_sigma_s <= kLargestTimeSigma_s ? time_sigma_s : 0.0;
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

class Geolocator::Implementation {
 public:
  explicit Implementation(const GeolocatorConfig& given)
      : config(checked(given)),
        state(config.state),
        viewer{state, config.camera.mount, config.camera_orientation},
        projector(config.projector, config.camera.intrinsics),
        ground(config.joint.sigma_ground_m),
        tracker(make_tracker(config)) {
    selected_.reserve(config.max_detections);
    located.reserve(config.max_detections);
    turned_located_.reserve(config.max_detections);
  }

  Expected<VehicleState, NoState> vehicle_at(VehicleTime captured_at) const {
    return state.at(captured_at - from_seconds(tracker->calibration().latency_s()));
  }

  void add(const RangeSample& sample);
  bool process(const FrameDetections& frame);
  void finish();

  const GeolocatorConfig config;
  StateProvider state;
  const FrameViewer viewer;
  const Projector projector;
  GroundModel ground;  // level until the vehicle's first position
  const std::unique_ptr<Tracker> tracker;
  FrameView view;
  std::vector<LocatedDetection> located;
  Counters counters;

 private:
  std::optional<double> range_at(VehicleTime time) const;
  void anchor_state(VehicleTime captured_at);
  FrameView lifted(FrameView nominal_view) const;
  void select(const std::vector<Detection>& detections);
  void locate(const FrameView& from, std::vector<LocatedDetection>& found,
              decltype(Counters::no_fix)& no_fix) const;
  LocatedFrame located_frame(const FrameStamp& stamp, const FrameView& from,
                             const std::vector<LocatedDetection>& detections) const;
  void track_either_way(const FrameStamp& stamp);
  bool may_be_turned(const FrameStamp& stamp);

  StateBuffer<double> ranges_;
  std::uint64_t reboots_ = 0;  // when ranges_ was begun
  bool has_object_ = false;    // a confirmed one
  std::vector<Detection> selected_;
  std::optional<FrameStamp> last_stamp_;          // of the frames located
  std::vector<LocatedDetection> turned_located_;  // scratch of track_either_way
};

/// A reboot sets the vehicle's clock back.
void Geolocator::Implementation::add(const RangeSample& sample) {
  if (!(sample.distance_m > 0.0) || !std::isfinite(sample.distance_m)) return;
  if (const auto reboots = state.counters().reboots; reboots != reboots_) {
    ranges_.clear();
    reboots_ = reboots;
  }
  if (ranges_.insert(sample.time, sample.distance_m)) ++counters.ranges;
}

/// The distance between two readings that are near to each other in time and length: not across a wall's
/// edge, and not across a spike.
std::optional<double> Geolocator::Implementation::range_at(VehicleTime time) const {
  constexpr double kLongestGap_s = 0.5, kMostChange = 0.2;
  const auto bracket = ranges_.bracket(time, from_seconds(kLongestGap_s), Duration::zero());
  if (!bracket) return std::nullopt;
  const double nearer_m = std::min(bracket->before, bracket->after);
  if (!(std::abs(bracket->after - bracket->before) <= kMostChange * nearer_m)) return std::nullopt;
  return bracket->interpolated();
}

bool Geolocator::Implementation::process(const FrameDetections& frame) {
  ++counters.frames;
  const FrameStamp stamp{frame.captured_at, frame.captured_at_host, usable_sigma(frame.time_sigma_s)};
  anchor_state(frame.captured_at);
  const auto nominal_view = viewer.nominal_view(stamp, tracker->calibration().latency_s());
  if (!nominal_view) {
    ++counters.frames_unusable;
    return false;
  }
  ++counters.frames_located;
  state.keep_frame();
  if (config.terrain && ground.is_level())
    ground = GroundModel(config.terrain, *state.local_frame(), config.joint.sigma_ground_m);
  view = lifted(*nominal_view);
  select(frame.detections);
  locate(view, located, counters.no_fix);
  if (may_be_turned(stamp)) {
    track_either_way(stamp);
  } else {
    tracker->update(located_frame(stamp, view, located));
  }
  return true;
}

void Geolocator::Implementation::finish() {
  if (last_stamp_) tracker->finish(located_frame(*last_stamp_, view, located));
}

LocatedFrame Geolocator::Implementation::located_frame(
    const FrameStamp& stamp, const FrameView& from, const std::vector<LocatedDetection>& detections) const {
  return {detections, projector, from,   *state.local_frame(),
          stamp,      viewer,    ground, range_at(from.vehicle.time)};
}

/// As the vehicle tells its yaw, or 180 deg from it.
void Geolocator::Implementation::track_either_way(const FrameStamp& stamp) {
  FrameStamp turned_stamp = stamp;
  turned_stamp.is_turned = true;
  const auto nominal_view = viewer.nominal_view(turned_stamp, tracker->calibration().latency_s());
  const FrameView turned_view = nominal_view ? lifted(*nominal_view) : view;
  decltype(Counters::no_fix) unused{};
  locate(turned_view, turned_located_, unused);
  const LocatedFrame turned = located_frame(turned_stamp, turned_view, turned_located_);
  LocatedFrame stated = located_frame(stamp, view, located);
  stated.turned = &turned;
  const std::uint64_t before = tracker->counters().frames_turned;
  tracker->update(stated);
  if (tracker->counters().frames_turned == before) return;
  view = turned_view;
  located.swap(turned_located_);
}

/// Within a second no vehicle turns round unseen.
bool Geolocator::Implementation::may_be_turned(const FrameStamp& stamp) {
  constexpr Duration kUnseen = std::chrono::seconds{1};
  const auto before = std::exchange(last_stamp_, stamp);
  return config.method == Method::kJoint && before &&
         stamp.captured_at_host - before->captured_at_host >= kUnseen;
}

/// The joint method's rays meet a level plane at the height of the ground below the vehicle.
FrameView Geolocator::Implementation::lifted(FrameView nominal_view) const {
  const Eigen::Vector3d& camera = nominal_view.enu_from_camera.translation;
  if (config.method == Method::kJoint) nominal_view.terrain_m = ground.height_m(camera.head<2>());
  return calibrated(nominal_view, tracker->calibration(),
                    tracker->lift_m(reported_height_m(nominal_view, config.projector)));
}

/// Nothing is on the map until an object is confirmed: of the states before and after a step, the newest is
/// more often right. From then on the map must not jump.
void Geolocator::Implementation::anchor_state(VehicleTime captured_at) {
  const auto& tracks = tracker->tracks();
  has_object_ = has_object_ || std::any_of(tracks.begin(), tracks.end(), [](const Track& track) {
                  return track.status == TrackStatus::kConfirmed;
                });
  if (!has_object_) state.anchor(captured_at - from_seconds(tracker->calibration().latency_s()));
}

void Geolocator::Implementation::select(const std::vector<Detection>& detections) {
  selected_.clear();
  const auto most = static_cast<std::size_t>(config.max_detections);
  for (const Detection& detection : detections) {
    if (!is_usable(detection)) {
      ++counters.detections_dropped;
    } else if (config.edge_margin_px > 0.0 &&
               may_be_cut(detection.box, config.camera.intrinsics, config.edge_margin_px)) {
      ++counters.detections_at_edge;
    } else if (selected_.size() < most) {
      selected_.push_back(detection);
    } else {
      ++counters.detections_dropped;
      const auto last = std::max_element(selected_.begin(), selected_.end(), canonical_order);
      if (canonical_order(detection, *last)) *last = detection;
    }
  }
  std::sort(selected_.begin(), selected_.end(), canonical_order);
  counters.detections += selected_.size();
}

void Geolocator::Implementation::locate(const FrameView& from, std::vector<LocatedDetection>& found,
                                        decltype(Counters::no_fix)& no_fix) const {
  found.clear();
  for (const Detection& detection : selected_) {
    const auto fix = config.method == Method::kJoint
                         ? projector.project(detection.box.centre(), from.enu_from_camera)
                         : projector.project(detection.box.centre(), from.enu_from_camera, ground);
    if (fix) {
      found.push_back({detection, *fix});
    } else {
      ++no_fix[static_cast<std::size_t>(fix.error())];
    }
  }
}

Geolocator::Geolocator(const GeolocatorConfig& config)
    : implementation_(std::make_unique<Implementation>(config)) {}
Geolocator::~Geolocator() = default;
Geolocator::Geolocator(Geolocator&&) noexcept = default;
Geolocator& Geolocator::operator=(Geolocator&&) noexcept = default;

void Geolocator::add(const AttitudeSample& sample) {
  implementation_->state.add(sample);
}

void Geolocator::add(const PositionSample& sample) {
  implementation_->state.add(sample);
}

void Geolocator::add(const RangeSample& sample) {
  implementation_->add(sample);
}

void Geolocator::on_vehicle_reboot() {
  implementation_->state.restart();
}

void Geolocator::on_vehicle_clock_step() {
  implementation_->state.on_clock_step();
}

std::optional<NoState> Geolocator::missing_state(VehicleTime captured_at) const {
  const auto vehicle = implementation_->vehicle_at(captured_at);
  if (vehicle) return std::nullopt;
  return vehicle.error();
}

bool Geolocator::process(const FrameDetections& frame) {
  return implementation_->process(frame);
}

void Geolocator::finish() {
  implementation_->finish();
}

const std::vector<Track>& Geolocator::tracks() const {
  return implementation_->tracker->tracks();
}

const std::vector<LocatedDetection>& Geolocator::located() const {
  return implementation_->located;
}

const FrameView& Geolocator::view() const {
  return implementation_->view;
}

std::optional<Calibration> Geolocator::calibration() const {
  return implementation_->tracker->calibration_of_camera();
}

const std::vector<KnownPointMatch>& Geolocator::known_points() const {
  return implementation_->tracker->known_points();
}

const std::optional<LocalFrame>& Geolocator::local_frame() const {
  return implementation_->state.local_frame();
}

const GeolocatorConfig& Geolocator::config() const {
  return implementation_->config;
}

const StateProvider& Geolocator::state() const {
  return implementation_->state;
}

const Projector& Geolocator::projector() const {
  return implementation_->projector;
}

const GroundModel& Geolocator::ground() const {
  return implementation_->ground;
}

const TrackCounters& Geolocator::track_counters() const {
  return implementation_->tracker->counters();
}

const Geolocator::Counters& Geolocator::counters() const {
  return implementation_->counters;
}

}  // namespace geoloc
