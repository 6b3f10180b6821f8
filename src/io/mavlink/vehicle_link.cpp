// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/vehicle_link.hpp"

#include <algorithm>
#include <chrono>
#include <variant>
#include <vector>

#include "geoloc/geometry/refuse.hpp"
#include "mav_numbers.hpp"
#include "timing.hpp"

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;

/// For this long after an ATTITUDE, ATTITUDE_QUATERNION adds nothing new.
constexpr Duration kEulerSilence = 1s;
/// For this long after a DISTANCE_SENSOR, RANGEFINDER adds nothing new.
constexpr Duration kRangeSilence = 2s;

/// Share of the fast rate at which it counts as come: autopilots round intervals to their scheduler.
constexpr double kNearlyFast = 0.6;

/// With the rates of a link that bears the fast one.
MavlinkConfig in_a_hurry(MavlinkConfig config) {
  for (double* rate_hz : {&config.attitude_rate_hz, &config.position_rate_hz, &config.gimbal_rate_hz}) {
    if (*rate_hz > 0.0) *rate_hz = std::max(*rate_hz, config.fast_rate_hz);
  }
  return config;
}

std::vector<WantedStream> wanted_streams(const MavlinkConfig& config, bool is_ardupilot, bool has_gimbal) {
  constexpr std::uint32_t kSystemTime = 2, kGpsRawInt = 24, kAttitude = 30, kGlobalPositionInt = 33;
  constexpr std::uint32_t kDistanceSensor = 132, kEkfStatusReport = 193, kEstimatorStatus = 230;
  constexpr std::uint32_t kMountOrientation = 265, kGimbalDeviceAttitudeStatus = 285;
  constexpr std::uint8_t kNone = 0, kExtendedStatus = 2, kPosition = 6, kExtra1 = 10, kExtra3 = 12;
  std::vector<WantedStream> streams{{kAttitude, config.attitude_rate_hz, kExtra1},
                                    {kGlobalPositionInt, config.position_rate_hz, kPosition},
                                    {kGpsRawInt, 2.0, kExtendedStatus},
                                    {kSystemTime, 1.0, kExtra3}};
  if (config.rangefinder_rate_hz > 0.0)
    streams.push_back({kDistanceSensor, config.rangefinder_rate_hz, kExtra3});
  if (has_gimbal && config.gimbal_rate_hz > 0.0) {
    streams.push_back({kGimbalDeviceAttitudeStatus, config.gimbal_rate_hz, kNone});
    streams.push_back({kMountOrientation, config.gimbal_rate_hz, kNone});
  }
  if (is_ardupilot) streams.push_back({kEkfStatusReport, 2.0, kExtra3});
  if (!is_ardupilot) streams.push_back({kEstimatorStatus, 1.0, kNone});
  return streams;
}

std::optional<Duration> since(const std::optional<HostTime>& time, HostTime now) {
  if (!time) return std::nullopt;
  return now - *time;
}

}  // namespace

VehicleLink::VehicleLink(const MavlinkConfig& config, bool has_gimbal)
    : config_(config),
      has_gimbal_(has_gimbal),
      choice_(config.system_id),
      gimbal_(config.gimbal),
      camera_(config) {
  refuse_if_any(config.problems());
}

bool VehicleLink::consume(HostTime received_at, const std::uint8_t* data, std::size_t size,
                          TelemetrySink& sink) {
  const Arrival arrival{received_at, sink};
  bool heard_vehicle = false;
  while (size > 0) {
    const std::size_t taken = parser_.append(data, size);
    data += taken;
    size -= taken;
    while (const auto frame = parser_.next()) heard_vehicle |= take(*frame, arrival);
  }
  return heard_vehicle;
}

bool VehicleLink::take(const Frame& frame, const Arrival& arrival) {
  arrival.sink.on_frame(arrival.at, frame.bytes, frame.size);
  const Message message = decode(frame);
  if (choice_.observe(frame, message, arrival.at)) begin_with_vehicle(arrival);
  if (frame.sender != choice_.vehicle()) {
    ++counts_.foreign_frames;
    if (is_of_vehicle(frame.sender)) take_of_component(frame, message, arrival);
    return false;
  }
  ++counts_.vehicle_frames;
  if (!is_alive(arrival.at)) ask_anew(arrival.at);
  last_heard_ = arrival.at;
  is_v2_ = frame.is_v2;
  requests_.on_message(frame.message_id, arrival.at);
  std::visit([&](const auto& content) { handle(content, arrival); }, message);
  return true;
}

/// The camera that geoloc itself is to ground stations (mavlink.camera) may be heard as an echo.
void VehicleLink::take_of_component(const Frame& frame, const Message& message, const Arrival& arrival) {
  const std::uint8_t component = frame.sender.component;
  if (config_.camera && component == config_.camera_component_id) return;
  const auto* const heartbeat = std::get_if<Heartbeat>(&message);
  camera_.hear(component, heartbeat != nullptr && heartbeat->is_from_camera(), arrival.at);
  camera_.on_message(component, frame.message_id, arrival.at);
  if (const auto* const gimbal = std::get_if<GimbalMessage>(&message)) {
    requests_.on_message(frame.message_id, arrival.at);
    take_gimbal(component, *gimbal, arrival);
  } else if (const auto* const view = std::get_if<FieldOfViewMessage>(&message)) {
    take_field_of_view(component, *view, arrival);
  } else if (const auto* const level = std::get_if<ZoomLevel>(&message)) {
    camera_.note(*level);
  } else if (const auto* const answer = std::get_if<CommandAck>(&message);
             answer && answer->command == kSetMessageInterval && is_for_us(answer->target)) {
    camera_.on_answer(component, answer->result, arrival.at);
  }
}

/// What was learnt of another vehicle does not hold for this one.
void VehicleLink::begin_with_vehicle(const Arrival& arrival) {
  boot_clock_ = BootClockMonitor{};
  clock_.restart();
  gate_ = PositionGate{};
  last_attitude_.reset();
  last_euler_attitude_.reset();
  last_position_.reset();
  last_refusal_.reset();
  last_stamped_range_.reset();
  gimbal_.restart();
  camera_.restart();
  last_heard_ = arrival.at;
  sender_.seek_clock();
  pace_.restart();
  want_streams(arrival.at);
  if (has_delivered_) arrival.sink.on_other_vehicle();
  has_delivered_ = false;
}

/// Before its own stamp no message comes. It is dropped, unless others confirm that the clock has stepped: a
/// sample from the future would be waited for, and hide those that come until then.
bool VehicleLink::accept_early_stamp(VehicleTime stamp, const Arrival& arrival) {
  const std::uint64_t steps_before = clock_.counts().steps;
  clock_.add_arrival(stamp, arrival.at);
  if (clock_.counts().steps == steps_before) {
    ++counts_.suspect_stamps;
    return false;
  }
  boot_clock_ = BootClockMonitor{};
  boot_clock_.observe(stamp);
  tell_of_clock_step(steps_before, arrival);
  return true;
}

bool VehicleLink::accept_stamp(VehicleTime stamp, const Arrival& arrival) {
  if (boot_clock_.is_near_newest(stamp) && clock_.is_early(stamp, arrival.at))
    return accept_early_stamp(stamp, arrival);
  switch (boot_clock_.observe(stamp)) {
    case BootClockMonitor::Verdict::kSuspect:
      ++counts_.suspect_stamps;
      return false;
    case BootClockMonitor::Verdict::kRebooted:
      ++counts_.reboots;
      clock_.restart();
      gate_ = PositionGate{};
      ask_anew(arrival.at);
      arrival.sink.on_reboot();
      break;
    case BootClockMonitor::Verdict::kAdvanced:
      break;
  }
  const std::uint64_t steps_before = clock_.counts().steps;
  clock_.add_arrival(stamp, arrival.at);
  tell_of_clock_step(steps_before, arrival);
  return true;
}

void VehicleLink::tell_of_clock_step(std::uint64_t steps_before, const Arrival& arrival) {
  if (clock_.counts().steps == steps_before) return;
  sender_.seek_clock();
  arrival.sink.on_clock_step(clock_.last_step());
}

void VehicleLink::handle(const AttitudeMessage& message, const Arrival& arrival) {
  if (!accept_stamp(message.sample.time, arrival)) return;
  if (!message.from_quaternion) last_euler_attitude_ = arrival.at;
  if (message.from_quaternion && last_euler_attitude_ && arrival.at - *last_euler_attitude_ < kEulerSilence) {
    ++counts_.second_attitudes;
    return;
  }
  ++counts_.attitudes;
  last_attitude_ = arrival.at;
  attitude_meter_.add(arrival.at);
  has_delivered_ = true;
  arrival.sink.on_attitude(message.sample);
}

void VehicleLink::handle(const PositionSample& message, const Arrival& arrival) {
  if (!accept_stamp(message.time, arrival)) return;
  last_refusal_ = gate_.refusal(message.position, arrival.at);
  if (last_refusal_) {
    ++counts_.no_fix_positions;
    return;
  }
  ++counts_.positions;
  last_position_ = arrival.at;
  position_meter_.add(arrival.at);
  PositionSample sample = message;
  sample.sigma_horizontal_m = gate_.sigma_horizontal_m(arrival.at);
  has_delivered_ = true;
  arrival.sink.on_position(sample);
}

/// RANGEFINDER tells what DISTANCE_SENSOR does, without the time: it is used where that does not come.
void VehicleLink::handle(const RangeMessage& message, const Arrival& arrival) {
  if (message.time) {
    if (!accept_stamp(*message.time, arrival)) return;
    last_stamped_range_ = arrival.at;
  } else if (last_stamped_range_ && arrival.at - *last_stamped_range_ < kRangeSilence) {
    return;
  }
  const auto time = message.time ? message.time : clock_.to_vehicle(arrival.at);
  if (!time) return;
  ++counts_.ranges;
  arrival.sink.on_range({*time, message.distance_m});
}

void VehicleLink::take_gimbal(std::uint8_t component, const GimbalMessage& message, const Arrival& arrival) {
  const auto sample = gimbal_.take(component, message, arrival.at, {clock_, boot_clock_}, counts_);
  if (sample) arrival.sink.on_gimbal(*sample);
}

void VehicleLink::take_field_of_view(std::uint8_t component, const FieldOfViewMessage& message,
                                     const Arrival& arrival) {
  const auto sample = camera_.take(component, message, arrival.at, {clock_, boot_clock_}, counts_);
  if (sample) arrival.sink.on_field_of_view(*sample);
}

void VehicleLink::handle(const Timesync& message, const Arrival& arrival) {
  const std::int64_t mark = message.requester_ns % kNanosecondsPerStamp;
  if (message.vehicle_ns == 0 || mark != config_.component_id || !is_for_us(message.target)) {
    ++counts_.foreign_timesyncs;
    return;
  }
  const std::uint64_t steps_before = clock_.counts().steps;
  const HostTime asked_at{Duration{message.requester_ns - mark}};
  clock_.add_round_trip(asked_at, VehicleTime{Duration{message.vehicle_ns}}, arrival.at);
  pace_.on_round_trip(arrival.at - asked_at);
  tell_of_clock_step(steps_before, arrival);
}

void VehicleLink::handle(const CommandAck& message, const Arrival& arrival) {
  if (message.command == kSetMessageInterval && is_for_us(message.target)) {
    requests_.on_answer(message.result, arrival.at);
  }
}

void VehicleLink::poll(HostTime now, const Send& send) {
  if (!choice_.vehicle()) return;
  // Until it hears version 2, a PX4 may speak version 1, which has no accuracies and no messages of gimbals.
  const LinkSender::Peers peers{self(), *choice_.vehicle(), is_v2_ || choice_.is_px4()};
  sender_.send_heartbeat(now, peers, send);
  if (!is_alive(now)) return;
  if (config_.fast_rate_hz > 0.0 && pace_.update(now, heard(now))) want_streams(now);
  sender_.send_due(now, peers, clock_.doubt() > Duration::zero(), requests_, camera_, send);
}

void VehicleLink::want_streams(HostTime now) {
  const MavlinkConfig config = pace_.is_fast() ? in_a_hurry(config_) : config_;
  requests_.want(wanted_streams(config, choice_.is_ardupilot(), has_gimbal_), now);
}

LinkPace::Heard VehicleLink::heard(HostTime now) const {
  const double least_hz = kNearlyFast * config_.fast_rate_hz;
  return {counts_.vehicle_frames, parser_.sequences().lost(*choice_.vehicle()),
          attitude_meter_.rate_hz(now) >= least_hz && position_meter_.rate_hz(now) >= least_hz};
}

void VehicleLink::ask_anew(HostTime now) {
  const bool was_fast = pace_.is_fast();
  pace_.restart();
  if (was_fast) {
    want_streams(now);
  } else {
    requests_.restart(now);
  }
  camera_.ask_anew(now);
  sender_.seek_clock();
}

MavAddress VehicleLink::self() const {
  return {choice_.vehicle()->system, static_cast<std::uint8_t>(config_.component_id)};
}

/// Senders that do not state whom they answer leave 0.
bool VehicleLink::is_for_us(MavAddress target) const {
  return (target.system == 0 || target.system == self().system) &&
         (target.component == 0 || target.component == self().component);
}

bool VehicleLink::is_alive(HostTime now) const {
  return now - last_heard_ <= from_seconds(config_.link_timeout_s);
}

bool VehicleLink::is_of_vehicle(MavAddress sender) const {
  return choice_.vehicle() && sender.system == choice_.vehicle()->system;
}

LinkStatus VehicleLink::status(HostTime now) const {
  LinkStatus status;
  status.vehicle = choice_.vehicle();
  status.other_system = choice_.other_system(now);
  status.is_v2 = is_v2_;
  status.fix_type = gate_.fix_type();
  const auto veto = gate_.veto(now);
  status.position_refusal = veto ? veto : last_refusal_;
  status.has_gnss_glitch = gate_.has_gnss_glitch(now);
  status.attitude_rate_hz = attitude_meter_.rate_hz(now);
  status.position_rate_hz = position_meter_.rate_hz(now);
  status.since_attitude = since(last_attitude_, now);
  status.since_position = since(last_position_, now);
  gimbal_.report(now, status);
  camera_.report(now, status);
  status.clock_source = clock_.source();
  status.clock_error_bound = clock_.error_bound();
  if (status.vehicle) status.lost_frames = parser_.sequences().lost(*status.vehicle);
  status.frames = parser_.counts();
  status.telemetry = counts_;
  status.clock = clock_.counts();
  status.requests = requests_.counts();
  return status;
}

}  // namespace geoloc::io
