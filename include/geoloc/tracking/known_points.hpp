// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/geometry/geodetic.hpp"
#include "geoloc/tracking/joint_association.hpp"

namespace geoloc {

/// An object whose place was surveyed. One or two take the receiver's constant offset out of all others.
struct KnownPoint {
  std::string name;
  Geodetic position;
  double sigma_m = 0.05;        ///< of the survey, an axis
  std::optional<int> class_id;  ///< unset: any

  std::vector<std::string> problems() const;
};

enum class KnownPointStatus {
  kNotCovered,  ///< the camera has not looked there for long enough
  kNoObject,    ///< it has, and no object there agrees with the survey and with the other points
  kAmbiguous,   ///< several objects may be the one
  kMatched
};

/// Which objects are the known points. All known points are off from their objects by the same error of the
/// vehicle's position, so they are matched jointly, and what contradicts the others is left out.
class KnownPoints {
 public:
  struct Entry {
    KnownPointStatus status = KnownPointStatus::kNotCovered;
    std::uint64_t track_id = 0;  ///< of a matched one
    Eigen::Vector2d position_in_enu = Eigen::Vector2d::Zero();
    double sigma_m = 0.0;
    std::optional<int> class_id;
    int frames_covered = 0;
  };

  /// An object that may be one of the points. One that is not confirmed yet is not matched, but stands in the
  /// way of its neighbours.
  struct Candidate {
    std::uint64_t track_id;
    bool is_confirmed;
    int class_id;
    Eigen::Vector2d position_in_enu;
  };

  KnownPoints(std::vector<KnownPoint> points, int max_tracks);

  /// Where the points are, once the local frame is known.
  void place(const LocalFrame& frame);
  bool is_placed() const { return is_placed_; }

  /// The camera looks at an entry's place and away from the image's edge.
  void cover(std::size_t entry) { ++entries_[entry].frames_covered; }

  /// Matches what is not matched yet. shared_sigma_m: of the error that all candidates' positions share, an
  /// axis; own_sigma_m: of the rest. True where something new was matched.
  bool match(const std::vector<Candidate>& candidates, double shared_sigma_m, double own_sigma_m, double gate,
             double ambiguity);

  /// Track `gone` is now called `kept`.
  void rename(std::uint64_t gone, std::uint64_t kept);

  /// A track is gone: its point is to be found again.
  void forget(std::uint64_t track_id);

  /// The entry that a track was matched to.
  const Entry* of_track(std::uint64_t track_id) const;

  const std::vector<Entry>& entries() const { return entries_; }
  const std::vector<KnownPoint>& points() const { return points_; }

 private:
  std::vector<KnownPoint> points_;
  std::vector<Entry> entries_;
  std::vector<std::size_t> open_;  // scratch: entries to match
  JointAssociation association_;
  bool is_placed_ = false;
};

}  // namespace geoloc
