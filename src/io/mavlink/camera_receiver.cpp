// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/camera_receiver.hpp"

#include <cmath>

#include "mav_numbers.hpp"

namespace geoloc::io {
namespace {

constexpr std::uint32_t kCameraFovStatus = 271;
/// Smaller changes are noise.
constexpr double kLeastChange = 0.01, kLeastChange_percent = 1.0;

/// One of them is told in every sample.
double told_angle_rad(const FieldOfViewSample& sample) {
  return sample.horizontal_rad ? *sample.horizontal_rad : *sample.vertical_rad;
}

bool is_camera_component(std::uint8_t component) {
  return component >= kFirstCameraComponent && component <= kLastCameraComponent;
}

}  // namespace

std::optional<FieldOfViewSample> CameraReceiver::take(std::uint8_t component,
                                                      const FieldOfViewMessage& message, HostTime received_at,
                                                      const VehicleClock& clock, TelemetryCounts& counts) {
  const std::uint8_t number = message.device_id != 0 ? message.device_id : component;
  const bool may_be_one = component == kAutopilotComponent || is_camera_component(component);
  if (!may_be_one || !is_it(number)) {
    ++counts.other_cameras;
    return std::nullopt;
  }
  const bool has_time = message.sample.time != VehicleTime{};
  const auto stamp = has_time ? std::optional(message.sample.time) : std::nullopt;
  const auto time = clock_.to_vehicle(component, stamp, received_at, clock);
  if (!time) {
    ++counts.suspect_stamps;
    return std::nullopt;
  }
  if (camera_ != number) widest_view_.reset();
  camera_ = number;
  note_view(message.sample);
  if (!has_changed(message.sample) && component == kAutopilotComponent) return std::nullopt;
  ++counts.fields_of_view;
  last_ = received_at;
  meter_.add(received_at);
  FieldOfViewSample sample = message.sample;
  sample.time = *time;
  return sample;
}

bool CameraReceiver::is_it(std::uint8_t number) const {
  if (number_ != 0) return number == number_;
  return !camera_ || *camera_ == number || (!is_camera_component(*camera_) && is_camera_component(number));
}

void CameraReceiver::note_view(const FieldOfViewSample& sample) {
  if (!widest_view_ || told_angle_rad(sample) > told_angle_rad(*widest_view_)) widest_view_ = sample;
}

bool CameraReceiver::has_changed(const FieldOfViewSample& sample) {
  const double angle_rad = told_angle_rad(sample);
  if (!first_angle_rad_) first_angle_rad_ = angle_rad;
  has_changed_ = has_changed_ || std::abs(angle_rad - *first_angle_rad_) > kLeastChange * *first_angle_rad_;
  return has_changed_;
}

void CameraReceiver::note(const ZoomLevel& level) {
  if (!first_level_percent_) first_level_percent_ = level.percent;
  has_level_changed_ =
      has_level_changed_ || std::abs(level.percent - *first_level_percent_) > kLeastChange_percent;
}

/// The first one that is heard is asked, or the one that is wanted.
void CameraReceiver::hear(std::uint8_t component, bool is_camera, HostTime received_at) {
  const bool is_wanted = number_ == 0 ? is_camera && !asked_ : component == number_ && asked_ != component;
  if (!is_wanted || !is_camera_component(component) || rate_hz_ <= 0.0) return;
  asked_ = component;
  requests_.want({{kCameraFovStatus, rate_hz_, 0}}, received_at);
}

void CameraReceiver::on_message(std::uint8_t component, std::uint32_t message_id, HostTime received_at) {
  if (asked_ == component) requests_.on_message(message_id, received_at);
}

void CameraReceiver::on_answer(std::uint8_t component, std::uint8_t result, HostTime received_at) {
  if (asked_ == component) requests_.on_answer(result, received_at);
}

void CameraReceiver::restart() {
  camera_.reset();
  asked_.reset();
  requests_.want({}, HostTime{});
  first_angle_rad_.reset();
  has_changed_ = false;
  widest_view_.reset();
  last_.reset();
  first_level_percent_.reset();
  has_level_changed_ = false;
}

void CameraReceiver::report(HostTime now, LinkStatus& status) const {
  if (last_) status.since_field_of_view = now - *last_;
  status.field_of_view_rate_hz = meter_.rate_hz(now);
  status.has_zoom_changed = has_changed_;
  status.widest_view = widest_view_;
  status.zooms_untold = has_level_changed_ && !last_;
}

}  // namespace geoloc::io
