// SPDX-License-Identifier: Apache-2.0
#include "common/link_message.hpp"

#include <fmt/format.h>

#include "common/count_list.hpp"
#include "common/view_contradiction.hpp"
#include "geoloc/state/state_provider.hpp"

namespace geoloc::apps {
namespace {

constexpr double kSilence_s = 3.0;
constexpr Duration kRefusalLasts = std::chrono::seconds{10};

bool is_silent(const std::optional<Duration>& since) {
  return !since || seconds(*since) > kSilence_s;
}

std::string of_another(const io::LinkStatus& link) {
  if (!link.other_system) return {};
  return fmt::format("; system {0} is heard, too: mavlink.system_id {0} would make it the vehicle",
                     *link.other_system);
}

std::string no_position(const io::LinkStatus& link) {
  const std::string comes = link.since_position ? "no position comes any more" : "no position comes";
  if (!link.position_refusal) return comes;
  switch (*link.position_refusal) {
    case io::PositionRefusal::kNoPlace:
      return comes + ": it sends latitude and longitude 0";
    case io::PositionRefusal::kNoFix:
      return link.since_position ? "its GNSS receiver has lost its fix" : "its GNSS receiver has no fix yet";
    case io::PositionRefusal::kNoAbsolutePosition:
      return comes + ": its estimator says that it does not know where it is";
  }
  return comes;
}

bool is_on_gimbal(const Geolocator& geolocator) {
  return geolocator.config().camera.mount.kind == MountKind::kGimbal;
}

/// Empty where frames can be located.
std::string fault(const io::LinkStatus& link, const Geolocator& geolocator) {
  using Use = StateProvider::PositionUse;
  const StateProvider& state = geolocator.state();
  if (is_silent(link.since_attitude)) return "no attitude comes";
  if (is_silent(link.since_position)) return no_position(link);
  if (state.position_use() == Use::kUnconfirmed) return "no two of its positions agree yet";
  if (state.position_use() == Use::kTooFar)
    return "its positions are more than 200 km from where the run began: a restart begins there";
  if (is_on_gimbal(geolocator) && is_silent(link.since_gimbal))
    return link.since_gimbal ? "no angles of the gimbal come any more" : kNoGimbalAngles;
  return {};
}

/// What is known of a camera's zoom; empty of one that tells none, or always the same.
std::string on_zoom(const io::LinkStatus& link, const Geolocator& geolocator) {
  const std::string contradiction = view_contradiction(link, geolocator.config().camera.intrinsics);
  if (!contradiction.empty()) return "; " + contradiction;
  if (link.zooms_untold)
    return "; the camera zooms (CAMERA_SETTINGS) and does not tell its field of view (CAMERA_FOV_STATUS): "
           "its focal length is taken to be the calibration's, which is wrong while it zooms";
  if (!link.has_zoom_changed) return {};
  if (is_silent(link.since_field_of_view))
    return "; its camera does not tell its field of view any more: the last one is taken to hold";
  return fmt::format("; its camera tells its zoom ({:.0f}/s)", link.field_of_view_rate_hz);
}

/// The message where telemetry comes.
std::string comes(const io::LinkStatus& link, const Geolocator& geolocator, TelemetryWay way) {
  const bool is_in_video = way == TelemetryWay::kVideo;
  const std::string telemetry = is_in_video ? "telemetry comes in the video" : "telemetry comes";
  if (!is_on_gimbal(geolocator)) return telemetry + on_zoom(link, geolocator);
  const std::string gimbal = is_in_video ? "its gimbal" : fmt::format("gimbal {}", link.gimbal->number());
  return fmt::format("{}, and the angles of {} ({:.0f}/s)", telemetry, gimbal, link.gimbal_rate_hz) +
         on_zoom(link, geolocator);
}

LinkMessage of_nobody(const io::LinkStatus& link, TelemetryWay way) {
  if (way == TelemetryWay::kUndecided)
    return {"telemetry: the video's first frames will show whether it carries any", false,
            "no telemetry came"};
  return {"waiting for a vehicle: no MAVLink heartbeat of an autopilot yet" + of_another(link), false,
          "no MAVLink heartbeat of an autopilot came" + of_another(link)};
}

}  // namespace

LinkMessage link_message(const io::LinkStatus& link, const Geolocator& geolocator, TelemetryWay way) {
  if (!link.vehicle) return of_nobody(link, way);
  const std::string vehicle = way == TelemetryWay::kVideo ? "telemetry in the video: "
                                                          : fmt::format("vehicle {}: ", link.vehicle->system);
  const std::string what = fault(link, geolocator);
  const std::string good = (way == TelemetryWay::kVideo ? "" : vehicle) + comes(link, geolocator, way);
  if (what.empty() && link.has_gnss_glitch)
    return {good + "; its estimator reports a GNSS glitch: the position may be off", true, {}};
  if (what.empty()) return {good, true, {}};
  return {vehicle + what + "; frames cannot be located" + of_another(link), false,
          vehicle + what + of_another(link)};
}

std::string refusal_message(const io::LinkGuard& guard, HostTime now) {
  const auto& signature = guard.last_refused_signature();
  if (signature && now - *signature < kRefusalLasts)
    return "messages that are not signed by mavlink.signing_key_file are refused: the vehicle needs the same "
           "key";
  const auto& second = guard.last_second_source();
  if (second && now - second->at < kRefusalLasts)
    return fmt::format("system {} speaks from {}: what {} sends under its name is refused", second->system,
                       to_string(second->speaks), to_string(second->refused));
  return {};
}

std::string count_of_refusals(const io::LinkGuard::Counts& counts) {
  return list_of_counts("MAVLink messages refused",
                        {{counts.unsigned_frames, "not signed"},
                         {counts.wrong_signatures, "signed by another key"},
                         {counts.repeated_signatures, "repeated"},
                         {counts.second_source, "of a second source of the same system"},
                         {counts.unasked_timesyncs, "that answered no TIMESYNC request"}});
}

}  // namespace geoloc::apps
