// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geoloc/tracking/track.hpp"
#include "geometry/room.hpp"

namespace geoloc {

/// The tracks of all objects in order of their ids, of which few change from frame to frame. Allocates when
/// constructed only.
class PublishedTracks {
 public:
  explicit PublishedTracks(std::size_t most) { take_room(this, most); }
  /// geometry/room.hpp
  static std::size_t take_room(PublishedTracks* self, std::size_t most) {
    return room::reserve(self, &PublishedTracks::tracks_, most);
  }

  const std::vector<Track>& all() const { return tracks_; }

  /// The track of that id. `place`: where it was last time, and where it is, so that it is found at once.
  Track* find(std::uint64_t id, std::size_t& place);

  /// The track of that id; nullptr: there is none.
  const Track* find(std::uint64_t id) const;

  /// Puts the track in the place of the one of its id, if there is one.
  void set(const Track& track, std::size_t& place);

  void remove(std::uint64_t id);
  void clear() { tracks_.clear(); }

 private:
  std::vector<Track> tracks_;
};

}  // namespace geoloc
