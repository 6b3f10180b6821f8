// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "calibration/shared_error.hpp"
#include "geoloc/tracking/assignment.hpp"

namespace geoloc {

/// A look that may show a track: residual = jacobian * shared error + noise of its own.
struct Pairing {
  std::size_t look = 0;
  std::size_t track = 0;
  Eigen::Vector2d residual;        ///< look minus track [m]
  SharedError::Row jacobian;       ///< of the residual, whitened [m]
  Eigen::Matrix2d own_covariance;  ///< detector's noise and what is not known of the track by itself [m^2]
  double penalty = 0.0;            ///< added to the squared distance: classes differ
};

/// Which look shows which track, where all looks are shifted by the same unknown errors: a row of objects may
/// fit better one place on, look by look, but not together. The assignment and the shared errors are
/// therefore estimated jointly, from several starts: each way to explain the most ambiguous looks. (Joint
/// compatibility, Neira and Tardos 2001; here with optimal assignments in place of a tree search.)
class JointAssociation {
 public:
  struct Match {
    std::optional<std::size_t> track;  ///< nullopt: the look shows none of them
    std::size_t pairing = 0;           ///< index into pairings(), where there is a track
    /// Another explanation of the frame, about as good, says otherwise: best learn nothing from this look.
    bool is_ambiguous = false;
    Eigen::Vector2d innovation;
    Eigen::Matrix2d innovation_covariance;

    /// Whether the look shows a track, and no other may be meant.
    bool is_certain() const { return track && !is_ambiguous; }
  };

  /// A look may as well be of something new where leaving it alone costs less than this more: less than the
  /// ambiguity between two tracks, since for want of a look a new object is begun and may be merged later.
  static constexpr double kAmbiguityAlone = 2.0;

  static constexpr std::size_t kMostExplanations = 32;

  /// most_explanations: tried of one frame.
  JointAssociation(int max_looks, int max_tracks, std::size_t most_explanations = kMostExplanations);
  /// geometry/room.hpp
  static std::size_t take_room(JointAssociation* self, int max_looks, int max_tracks,
                               std::size_t most_explanations = kMostExplanations);

  /// A new frame. gate: squared Mahalanobis distance at which a look is rather left alone; ambiguity: as much
  /// worse, in the same units, an explanation may be to be held possible.
  void begin(std::size_t looks, double gate, double ambiguity);

  /// Objects not known yet that stand where the look falls, per area [1/m^2].
  void expect_new(std::size_t look, double density);

  /// A pair that may belong together; those beyond the gate by themselves are dropped.
  void add(const Pairing& pairing);

  /// -2 ln of the probability density of the explanation that solve() found, but for a constant.
  double cost() const;

  /// One match per look. Where no look has a choice, each goes to its track, which is a good deal faster.
  const std::vector<Match>& solve();

  /// The same, but looks must agree also where none has a choice, and of each pair the best explanation that
  /// holds it is compared, and the best that leaves a look alone.
  const std::vector<Match>& solve_thoroughly();

  /// Pairs within the gate, in the order they were added.
  const std::vector<Pairing>& pairings() const { return pairings_; }

  /// How many looks of the frame may show a track that has a pairing.
  int looks_at(std::size_t track) const { return pairings_of_column_[column_of_track_[track]]; }

  /// That pair, by itself: nothing is known of the shared error yet.
  Match match_of(const Pairing& pairing) const;

 private:
  /// Shared error given some pairs.
  struct Posterior {
    SharedError::Vector mean = SharedError::Vector::Zero();
    SharedError::Matrix covariance = SharedError::Matrix::Identity();
    double cost = 0.0;  // of the pairs, jointly: -2 ln of their probability density, but for a constant

    void add(const Pairing& pairing);
  };

  /// One explanation of the frame.
  struct Hypothesis {
    std::vector<std::size_t> pairing_of_look;  // kNone: left alone
    double cost = 0.0;
    Posterior posterior;
  };

  enum class Starts { kAmbiguousLooks, kEveryPairing };
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  bool is_doubtful(std::size_t look) const;
  bool is_plain() const;
  /// What an explanation is to hold, whatever fits better.
  struct Held {
    std::size_t look_left_alone = kNone;
    const Pairing* pairing = nullptr;
    double cost = 0.0;  ///< of holding that

    bool excludes(const Pairing& other) const {
      return other.look == look_left_alone ||
             (pairing != nullptr && other.look == pairing->look && other.track != pairing->track);
    }
  };

  void explain(const Pairing* start, const Held& held);
  void assign(const Posterior& posterior, const Held& held, std::vector<std::size_t>& pairing_of_look);
  void try_other_explanations(Starts starts);
  void report_best();
  std::optional<std::size_t> track_of(const Hypothesis& hypothesis, std::size_t look) const;

  double gate_ = 0.0;
  double ambiguity_ = 0.0;
  std::vector<Pairing> pairings_;
  std::vector<int> pairings_of_look_;  // how many
  std::vector<double> least_cost_of_look_;
  std::vector<double> cost_alone_of_look_;
  std::vector<std::size_t> column_of_track_;  // kNone where it is in no pair
  std::vector<std::size_t> track_of_column_;
  std::vector<int> pairings_of_column_;
  Eigen::MatrixXd costs_;  // looks x tracks that are in a pair
  Eigen::Matrix<std::size_t, Eigen::Dynamic, Eigen::Dynamic> pairing_at_;  // the same shape
  AssignmentSolver assignment_;
  std::vector<Hypothesis> hypotheses_;  // the first `hypothesis_count_` are in use
  std::size_t hypothesis_count_ = 0;
  std::vector<Match> matches_;
};

}  // namespace geoloc
