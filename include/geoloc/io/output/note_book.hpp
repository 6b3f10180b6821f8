// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <vector>

#include "geoloc/io/object_note.hpp"
#include "geoloc/io/output/object_report.hpp"

namespace geoloc::io {

/// The notes of a run, for all of its outputs. Thread-safe and bounded.
class NoteBook {
 public:
  /// A note replaces the one of the same object. False where there are too many.
  bool add(const NotedObject& noted);

  /// Notes of an earlier run of the same recording.
  void load(const std::vector<NotedObject>& notes);

  /// Puts the notes to their objects: those of the same id and about the same place. Where that one is gone,
  /// as after a merger or with other settings, the note goes to the nearest object within two metres.
  void apply(std::vector<ObjectReport>& objects) const;

  /// What was added since the last call, in order.
  std::vector<NotedObject> take_added();

 private:
  bool keep(NotedObject noted);

  mutable std::mutex mutex_;                    // guards what follows
  std::map<std::uint64_t, NotedObject> notes_;  // by object
  std::vector<NotedObject> added_;
};

}  // namespace geoloc::io
