// SPDX-License-Identifier: Apache-2.0
#include "tracking/published_tracks.hpp"

#include <algorithm>

namespace geoloc {

namespace {

std::size_t place_of(std::uint64_t id, const std::vector<Track>& tracks) {
  const auto is_before = [](const Track& track, std::uint64_t sought) { return track.id < sought; };
  return static_cast<std::size_t>(std::lower_bound(tracks.begin(), tracks.end(), id, is_before) -
                                  tracks.begin());
}

}  // namespace

Track* PublishedTracks::find(std::uint64_t id, std::size_t& place) {
  if (place >= tracks_.size() || tracks_[place].id != id) place = place_of(id, tracks_);
  return place < tracks_.size() && tracks_[place].id == id ? &tracks_[place] : nullptr;
}

const Track* PublishedTracks::find(std::uint64_t id) const {
  const std::size_t place = place_of(id, tracks_);
  return place < tracks_.size() && tracks_[place].id == id ? &tracks_[place] : nullptr;
}

void PublishedTracks::set(const Track& track, std::size_t& place) {
  if (Track* const known = find(track.id, place)) {
    *known = track;
  } else {
    tracks_.insert(tracks_.begin() + static_cast<std::ptrdiff_t>(place), track);
  }
}

void PublishedTracks::remove(std::uint64_t id) {
  std::size_t place = tracks_.size();
  if (find(id, place) != nullptr) tracks_.erase(tracks_.begin() + static_cast<std::ptrdiff_t>(place));
}

}  // namespace geoloc
