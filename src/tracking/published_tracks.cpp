// SPDX-License-Identifier: Apache-2.0
#include "tracking/published_tracks.hpp"

#include <algorithm>

namespace geoloc {

Track* PublishedTracks::find(std::uint64_t id, std::size_t& place) {
  if (place >= tracks_.size() || tracks_[place].id != id) {
    const auto is_before = [](const Track& track, std::uint64_t sought) { return track.id < sought; };
    const auto found = std::lower_bound(tracks_.begin(), tracks_.end(), id, is_before);
    place = static_cast<std::size_t>(found - tracks_.begin());
  }
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
