// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace geoloc {

/// Same-frame evidence of one track against those near it: two tracks that were matched to two detections of
/// one frame are two objects. Twice is proof, and stays so; once may be a detector that fired twice, and
/// wears off. The dozen with the strongest evidence are kept.
class Neighbours {
 public:
  static constexpr std::size_t kMost = 12;

  void seen_apart(std::uint64_t other) { entry(other).evidence += 1.0; }

  /// One detection where both should have given one: weaker, since detectors miss.
  void seen_as_one(std::uint64_t other) {
    for (Entry& candidate : entries_) {
      if (candidate.other != other || candidate.evidence >= kProof) continue;
      candidate.evidence = std::max(0.0, candidate.evidence - 0.25);
    }
  }

  /// Two objects, as far as the frames tell: proven, or seen so once and not yet worn off.
  bool are_apart(std::uint64_t other) const { return evidence_against(other) > kDoubt; }

  /// Those that are_apart() holds for; 0 stands for none.
  std::array<std::uint64_t, kMost> apart() const {
    std::array<std::uint64_t, kMost> others{};
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      if (entries_[i].evidence > kDoubt) others[i] = entries_[i].other;
    }
    return others;
  }

  /// `gone` is now known as `kept`.
  void rename(std::uint64_t gone, std::uint64_t kept) {
    const double evidence = evidence_against(gone);
    if (evidence == 0.0) return;
    entry(gone) = Entry{};
    entry(kept).evidence += evidence;
  }

  void merge(const Neighbours& others) {
    for (const Entry& theirs : others.entries_) {
      if (theirs.evidence > 0.0) entry(theirs.other).evidence += theirs.evidence;
    }
  }

 private:
  static constexpr double kProof = 2.0;
  static constexpr double kDoubt = 0.5;

  struct Entry {
    std::uint64_t other = 0;  // ids start at 1
    double evidence = 0.0;
  };

  double evidence_against(std::uint64_t other) const {
    for (const Entry& candidate : entries_) {
      if (candidate.other == other) return candidate.evidence;
    }
    return 0.0;
  }

  Entry& entry(std::uint64_t other) {
    Entry* weakest = &entries_[0];
    for (Entry& candidate : entries_) {
      if (candidate.other == other) return candidate;
      if (candidate.evidence < weakest->evidence) weakest = &candidate;
    }
    *weakest = {other, 0.0};
    return *weakest;
  }

  std::array<Entry, kMost> entries_{};
};

}  // namespace geoloc
