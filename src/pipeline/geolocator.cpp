// SPDX-License-Identifier: Apache-2.0
#include "geoloc/pipeline/geolocator.hpp"

#include "geoloc/geometry/refuse.hpp"
#include "pipeline/geolocator_fields.hpp"
#include "pipeline/geolocator_implementation.hpp"
#include "settings/field_checker.hpp"

namespace geoloc {

std::vector<std::string> GeolocatorConfig::problems() const {
  return check_fields(*this);
}

Expected<Geolocator, std::vector<std::string>> Geolocator::create(const GeolocatorConfig& config) {
  if (auto problems = config.problems(); !problems.empty()) return problems;
  return Geolocator(config);
}

Geolocator::Geolocator(const GeolocatorConfig& config)
    : implementation_(std::make_unique<Implementation>(config)) {}
Geolocator::~Geolocator() = default;
Geolocator::Geolocator(Geolocator&&) noexcept = default;
Geolocator& Geolocator::operator=(Geolocator&&) noexcept = default;

std::size_t Geolocator::memory_needed(const GeolocatorConfig& config) {
  refuse_if_any(config.problems());
  return sizeof(Implementation) + Implementation::take_room(nullptr, config);
}

void Geolocator::add(const AttitudeSample& sample) {
  implementation_->state.add(sample);
}

void Geolocator::add(const PositionSample& sample) {
  implementation_->state.add(sample);
}

void Geolocator::add(const RangeSample& sample) {
  implementation_->add(sample);
}

void Geolocator::add(const GimbalSample& sample) {
  implementation_->add(sample);
}

void Geolocator::add(const FieldOfViewSample& sample) {
  implementation_->add(sample);
}

std::optional<FrameOutcome> Geolocator::add(const FrameDetections& frame) {
  return implementation_->add(frame);
}

std::optional<FrameOutcome> Geolocator::process_next(FrameWait wait) {
  return implementation_->process_next(wait);
}

std::size_t Geolocator::frames_waiting() const {
  return implementation_->waiting.size();
}

void Geolocator::on_vehicle_reboot() {
  implementation_->state.restart();
}

void Geolocator::on_vehicle_clock_step() {
  implementation_->state.on_clock_step();
}

std::optional<NoState> Geolocator::missing_state(VehicleTime captured_at) const {
  return implementation_->missing_state(captured_at);
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

std::optional<JointEstimate> Geolocator::joint_estimate() const {
  if (!implementation_->state.local_frame()) return std::nullopt;
  return implementation_->tracker->estimate(implementation_->projector.config().ground_height_above_home_m);
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
