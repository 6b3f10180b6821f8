// SPDX-License-Identifier: Apache-2.0
#include "tracking/recent_looks.hpp"

#include <algorithm>

#include "geometry/room.hpp"

namespace geoloc {
namespace {

/// Room for so many frames of as many looks as one may have; frames of fewer looks last for longer.
constexpr std::size_t kFramesRemembered = 16;
constexpr std::size_t kLeastEntries = 1000;

}  // namespace

RecentLooks::RecentLooks(int max_looks_per_frame) {
  take_room(this, max_looks_per_frame);
}

std::size_t RecentLooks::take_room(RecentLooks* self, int max_looks_per_frame) {
  const auto looks = static_cast<std::size_t>(max_looks_per_frame);
  return room::resize(self, &RecentLooks::entries_, std::max(kLeastEntries, kFramesRemembered * looks));
}

void RecentLooks::add(std::uint64_t track_id, VehicleTime time, const Look& look) {
  entries_[next_] = {track_id, time, look.observation, look.pixel_noise};
  next_ = (next_ + 1) % entries_.size();
  size_ = std::min(size_ + 1, entries_.size());
}

void RecentLooks::forget(std::uint64_t track_id, const LandmarkObservation& observation) {
  for (std::size_t i = 0; i < size_; ++i) {
    Entry& entry = entries_[i];
    if (entry.track_id != track_id || entry.observation.span.first != observation.span.first ||
        entry.observation.value != observation.value)
      continue;
    entry.track_id = 0;
    return;
  }
}

void RecentLooks::rename(std::uint64_t gone, std::uint64_t kept) {
  for (std::size_t i = 0; i < size_; ++i) {
    Entry& entry = entries_[i];
    if (entry.track_id == gone) entry.track_id = kept;
  }
}

void RecentLooks::take_out(VehicleTime since, const DriftTimeline& drift, TrackTable& tracks) {
  for (std::size_t i = 0; i < size_; ++i) {
    const Entry& entry = entries_[i];
    if (entry.time < since || entry.observation.span.first < drift.begin_of_fine()) continue;
    RestingObject* const object = tracks.find(entry.track_id);
    if (object == nullptr || object->sums_since >= since) continue;
    take_out_look(*object, entry.observation, entry.pixel_noise, drift);
  }
}

}  // namespace geoloc
