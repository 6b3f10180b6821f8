// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/geometry/time.hpp"
#include "geoloc/io/output/object_report.hpp"

namespace geoloc::io {

/// The objects of a run as pages see them, each with its best picture. Changes are numbered, and objects kept
/// in order of their last ones, so that what is new to a page is found without a look at all others. Memory
/// is bounded.
class LiveObjects {
 public:
  static constexpr std::size_t kMost = 200'000;

  /// Objects beyond `most` are counted, and not shown.
  explicit LiveObjects(std::size_t most = kMost) : most_(most) {}

  struct Counts {
    std::size_t confirmed = 0;
    std::size_t not_shown = 0;
  };

  struct Changes {
    std::string objects = {};  ///< JSON array
    std::uint64_t last = 0;    ///< number of the last change among them
    bool are_all = true;       ///< of those that there are
  };

  /// Takes what the revision says of an object. Fastest where objects come in order of their ids.
  void add(const ObjectReport& report, bool is_confirmed, HostTime at, std::uint64_t revision);
  /// Removes those that the revision does not have; with `only_confirmed`, no tentative ones.
  void remove_others(std::uint64_t revision, bool only_confirmed);
  void clear();

  /// Returns the object; nullptr, and nothing is changed, for what is no confirmed one.
  const ObjectReport* set_note(std::uint64_t id, const ObjectNote& note);

  // Pictures outlive the objects: a replay that begins again has them.

  /// False where there is no room for it.
  bool set_picture(std::uint64_t id, std::string jpeg);
  /// False where there was none.
  bool forget_picture(std::uint64_t id);
  std::shared_ptr<const std::string> picture_of(std::uint64_t id) const;

  std::vector<ObjectReport> all_confirmed() const;
  Counts counts() const { return {confirmed_, not_shown_}; }

  /// What has changed since the change of that number: the oldest news first, a few thousand of them.
  Changes changed_since(std::uint64_t change) const;
  /// JSON array of the ids that are gone since that revision; nullopt where that is no longer known.
  std::optional<std::string> removed_since(std::uint64_t revision) const;
  /// JSON array of the ids that there are.
  std::string ids() const;
  /// JSON of one object: its coordinates in several notations, and its history. nullopt for an unknown id.
  std::optional<std::string> details(std::uint64_t id) const;

 private:
  /// How well an object was known at one time.
  struct Moment {
    HostTime at;
    int hits;
    double sigma_major_m;
  };
  struct Entry {
    ObjectReport report;
    bool is_confirmed = false;
    std::string json;
    std::uint64_t change = 0;   // number of the last one
    std::uint64_t seen_in = 0;  // the update it was last part of
    std::vector<Moment> history;
    std::list<std::uint64_t>::iterator place;  // in changed_
  };
  struct Picture {
    std::shared_ptr<const std::string> jpeg;
    std::uint64_t number = 0;
  };
  struct Removal {
    std::uint64_t revision;
    std::uint64_t id;
  };
  using Entries = std::map<std::uint64_t, Entry>;

  static void note_moment(Entry& entry, HostTime at);
  Entry* find_or_make(std::uint64_t id, std::uint64_t revision);
  void show_picture_of(std::uint64_t id);
  void write_json(std::uint64_t id, Entry& entry);
  void note_removal(std::uint64_t id, std::uint64_t revision);

  std::size_t most_;
  Entries entries_;
  Entries::iterator next_ = entries_.end();  // where the next object is expected
  std::list<std::uint64_t> changed_;         // ids in order of their last changes
  std::uint64_t changes_made_ = 0;
  std::deque<Removal> removals_;          // the latest ones, in order
  std::uint64_t removals_forgotten_ = 0;  // revision of the last removal that is not among them
  std::size_t confirmed_ = 0;
  std::size_t not_shown_ = 0;
  std::uint64_t counted_in_ = 0;  // the update that not_shown_ counts
  std::map<std::uint64_t, Picture> pictures_;
  std::uint64_t pictures_made_ = 0;
};

}  // namespace geoloc::io
