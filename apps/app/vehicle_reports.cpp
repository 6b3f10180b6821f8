// SPDX-License-Identifier: Apache-2.0
#include "app/vehicle_reports.hpp"

#include <fmt/format.h>

#include <utility>

#include "app/camera_view.hpp"
#include "geoloc/io/output/object_report.hpp"
#include "geoloc/io/output/text.hpp"

namespace geoloc::apps {

VehicleReports::VehicleReports(const EstimationConfig& config, std::vector<std::string> class_names)
    : says_texts_(config.mavlink.status_text), class_names_(std::move(class_names)) {
  if (config.mavlink.camera)
    camera_.emplace(static_cast<std::uint8_t>(config.mavlink.camera_component_id),
                    config.geolocator.camera.intrinsics);
}

void VehicleReports::on_telemetry(const std::uint8_t* frame, std::size_t size) {
  if (camera_) camera_->consume(frame, size);
}

void VehicleReports::on_frame(Session& session, HostTime captured_at) {
  if (camera_) camera_->update(camera_view(session.geolocator(), captured_at));
  if (says_texts_) announce(session.geolocator(), session.link());
}

void VehicleReports::announce(const Geolocator& geolocator, io::VehicleLink& link) {
  for (const Track& track : geolocator.tracks()) {
    if (track.status != TrackStatus::kConfirmed || !announced_.insert(track.id).second) continue;
    const Geodetic place = geolocator.local_frame()->to_geodetic(track.position_in_enu.mean);
    const std::string what = io::ascii_text(io::class_name_of(track.class_id(), class_names_), 16) + " " +
                             std::to_string(track.id);
    link.say(fmt::format("{}: {:.6f}, {:.6f}", what, place.latitude_deg, place.longitude_deg));
  }
}

void VehicleReports::poll(HostTime now, const Session& session, const io::CameraComponent::Send& send) {
  if (!camera_) return;
  const io::LinkStatus link = session.link().status(now);
  camera_->poll(now, link.vehicle, link.is_v2, send);
}

}  // namespace geoloc::apps
