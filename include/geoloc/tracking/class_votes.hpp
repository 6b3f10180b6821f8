// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

namespace geoloc {

/// Which class an object is, by confidence-weighted majority. Constant size: the few most frequent classes
/// are kept (Misra-Gries), which is exact for any class that holds more than a fifth of the votes.
class ClassVotes {
 public:
  void add(int class_id, double weight) {
    Vote* weakest = &votes_[0];
    for (Vote& vote : votes_) {
      if (vote.weight > 0.0 && vote.class_id == class_id) {
        vote.weight += weight;
        return;
      }
      if (vote.weight < weakest->weight) weakest = &vote;
    }
    if (weakest->weight <= weight) {
      const double taken = weakest->weight;
      *weakest = {class_id, weight};
      for (Vote& vote : votes_) {
        if (&vote != weakest) vote.weight -= taken;
      }
    } else {
      for (Vote& vote : votes_) vote.weight -= weight;
    }
  }

  void add(const ClassVotes& other) {
    for (const Vote& vote : other.votes_) {
      if (vote.weight > 0.0) add(vote.class_id, vote.weight);
    }
  }

  struct Vote {
    int class_id = 0;
    double weight = 0.0;  ///< 0: there is no vote
  };
  using Votes = std::array<Vote, 4>;
  const Votes& votes() const { return votes_; }

  ClassVotes() = default;
  /// As votes() told them.
  explicit ClassVotes(const Votes& votes) : votes_(votes) {}

  /// The smaller class id where votes are equal; 0 before any vote.
  int winner() const {
    const Vote* best = &votes_[0];
    for (const Vote& vote : votes_) {
      const bool ahead = vote.weight > best->weight;
      const bool tied = vote.weight == best->weight && vote.class_id < best->class_id;
      if (ahead || tied) best = &vote;
    }
    return best->class_id;
  }

 private:
  Votes votes_{};
};

}  // namespace geoloc
