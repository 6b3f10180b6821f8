// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "geoloc/geometry/geodetic.hpp"
#include "geoloc/geometry/time.hpp"

// What people say of objects. It is kept beside the results and in the recording; the estimator knows nothing
// of it.
namespace geoloc::io {

enum class Verdict { kNone, kConfirmed, kDismissed };

inline constexpr std::array<const char*, 3> kVerdictNames{"", "confirmed", "dismissed"};

inline const char* word_of(Verdict verdict) {
  return kVerdictNames[static_cast<std::size_t>(verdict)];
}

/// The inverse of word_of(); nullopt for any other word.
inline std::optional<Verdict> parse_verdict(std::string_view word) {
  for (std::size_t i = 0; i < kVerdictNames.size(); ++i) {
    if (word == kVerdictNames[i]) return static_cast<Verdict>(i);
  }
  return std::nullopt;
}

inline constexpr std::size_t kLongestNoteName = 60;  ///< characters

/// An operator's name for an object, and whether there is one in the operator's view.
struct ObjectNote {
  std::string name;
  Verdict verdict = Verdict::kNone;

  bool is_empty() const { return name.empty() && verdict == Verdict::kNone; }
  bool operator==(const ObjectNote& other) const { return name == other.name && verdict == other.verdict; }
};

/// A note with the object that it was made of: one line of a recording's notes.jsonl.
struct NotedObject {
  HostTime at;  ///< of the run, when the note was made
  std::uint64_t object_id = 0;
  Geodetic position;  ///< of the object then
  ObjectNote note;    ///< an empty one takes the last one back
};

}  // namespace geoloc::io
