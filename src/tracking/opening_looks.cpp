// SPDX-License-Identifier: Apache-2.0
#include "tracking/opening_looks.hpp"
#include "geometry/room.hpp"

namespace geoloc {
namespace {

/// Ten seconds at ten frames a second, and ten looks in each.
constexpr std::size_t kMostFrames = 100;
constexpr std::size_t kMostSightings = 1000;

/// Rays that met the ground may miss it at another calibration. An object that has none left stays about
/// where it was, for its next look or for being missed: sums of nothing would leave no solution.
void keep_in_place_without_looks(RestingObject& object) {
  constexpr double kSigma_m = 10.0;
  if (has_looks(object)) return;
  PointInformation about_here;
  about_here.matrix = PointMatrix::Identity() / (kSigma_m * kSigma_m);
  about_here.vector = about_here.matrix * object.position_in_enu;
  object.landmark->add_prior(about_here);
  object.pixel_information += about_here.matrix;
}

}  // namespace

OpeningLooks::OpeningLooks() {
  take_room(this);
}

std::size_t OpeningLooks::take_room(OpeningLooks* self) {
  return room::reserve(self, &OpeningLooks::frames_, kMostFrames) +
         room::reserve(self, &OpeningLooks::sightings_, kMostSightings);
}

void OpeningLooks::restart() {
  is_open_ = true;
  frames_.clear();
  sightings_.clear();
}

void OpeningLooks::begin_frame(FrameStamp stamp, const JointFrame& frame, double looks_that_share) {
  if (frames_.size() == kMostFrames) is_open_ = false;
  if (!is_open_) return;
  frames_.push_back({stamp, std::nullopt, frame.view.terrain_m, frame.time(), frame.span, frame.repetition,
                     looks_that_share, frame.run_time, sightings_.size(), sightings_.size()});
}

void OpeningLooks::add(std::uint64_t track_id, const Detection& detection) {
  if (sightings_.size() == kMostSightings) is_open_ = false;
  if (!is_open_) return;
  sightings_.push_back({track_id, detection});
  ++frames_.back().end;
}

void OpeningLooks::rename(std::uint64_t gone, std::uint64_t kept) {
  if (!is_open_) return;
  for (Sighting& sighting : sightings_) {
    if (sighting.track_id == gone) sighting.track_id = kept;
  }
}

void OpeningLooks::linearise_anew(const FrameViewer& viewer, const Projector& projector,
                                  const LookMaker& maker, const SharedErrorEstimate& errors,
                                  TrackTable& tracks, RecentLooks& recent) {
  for (RestingObject& object : tracks) clear_sums(object);
  recent.clear();
  for (Frame& frame : frames_) {
    if (frame.begin == frame.end) continue;
    if (const auto found = viewer.nominal_view(frame.stamp, errors.calibration.latency_s()))
      frame.nominal_view = *found;
    if (!frame.nominal_view) continue;
    frame.nominal_view->terrain_m = frame.terrain_m;
    const double reported_m = reported_height_m(*frame.nominal_view, projector.config());
    const FrameView view = calibrated(*frame.nominal_view, errors.calibration, errors.lift_m(reported_m));
    linearise_anew(frame, view, projector, maker, errors, tracks, recent);
  }
  for (RestingObject& object : tracks) keep_in_place_without_looks(object);
}

void OpeningLooks::linearise_anew(const Frame& frame, const FrameView& view, const Projector& projector,
                                  const LookMaker& maker, const SharedErrorEstimate& errors,
                                  TrackTable& tracks, RecentLooks& recent) const {
  const JointFrame as_before{projector,        view, frame.span, errors.drift.at(frame.span),
                             frame.repetition, 0.0,  0.0,        frame.run_time};
  for (std::size_t i = frame.begin; i < frame.end; ++i) {
    const Sighting& sighting = sightings_[i];
    RestingObject* const object = tracks.find(sighting.track_id);
    if (object == nullptr || frame.time < object->sums_since) continue;
    const auto fix = projector.project(sighting.detection.box.centre(), view);
    if (!fix) continue;
    const Look look = maker.make_look({sighting.detection, *fix}, frame.looks_that_share, as_before, errors);
    add_look(*object, look, errors.drift);
    recent.add(sighting.track_id, frame.time, look);
  }
}

}  // namespace geoloc
