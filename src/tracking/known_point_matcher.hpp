// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "calibration/landmark.hpp"
#include "geoloc/geometry/geodetic.hpp"
#include "geoloc/geometry/time.hpp"
#include "geoloc/projection/ground_model.hpp"
#include "geoloc/tracking/known_points.hpp"
#include "tracking/joint_association.hpp"

namespace geoloc {

/// Which objects are the known points. All known points are off from their objects by the same error of the
/// vehicle's position, so they are matched jointly, and what contradicts the others is left out.
class KnownPointMatcher {
 public:
  /// An object that may be one of the points. One that is not confirmed yet is not matched, but stands in the
  /// way of its neighbours.
  struct Candidate {
    std::uint64_t track_id;
    bool is_confirmed;
    int class_id;
    Eigen::Vector2d position_in_enu;
    double own_sigma_m;  ///< 1-sigma per axis of what it is off by besides the error that all share
  };

  /// What a matched point says of its object.
  struct Survey {
    Eigen::Vector2d position_in_enu;
    double sigma_m;               ///< 1-sigma per axis
    double up_m = 0.0;            ///< above the level ground
    double sigma_height_m = 0.0;  ///< 1-sigma; 0: nothing is said of the height

    /// As a prior of the object.
    PointInformation information() const {
      const double per_axis = 1.0 / (sigma_m * sigma_m);
      const double of_height = sigma_height_m > 0.0 ? 1.0 / (sigma_height_m * sigma_height_m) : 0.0;
      const Point diagonal(per_axis, per_axis, of_height);
      return {diagonal.asDiagonal(),
              diagonal.cwiseProduct(Point(position_in_enu.x(), position_in_enu.y(), up_m))};
    }
  };

  KnownPointMatcher(std::vector<KnownPoint> points, int max_tracks);
  /// geometry/room.hpp
  static std::size_t take_room(KnownPointMatcher* self, const std::vector<KnownPoint>& points,
                               int max_tracks);

  bool is_empty() const { return points_.empty(); }
  const std::vector<KnownPoint>& points() const { return points_; }

  /// Whether the object of any point is known.
  bool has_matched() const {
    return std::any_of(matches_.begin(), matches_.end(), [](const KnownPointMatch& match) {
      return match.status == KnownPointStatus::kMatched;
    });
  }

  /// Notes the points that a frame covers. `is_covered(point_in_enu)` tells whether the camera looks at a
  /// place on the ground and away from the image's edge; an object there is found with that probability.
  template <typename IsCovered>
  void cover(const LocalFrame& frame, const GroundModel& ground, VehicleTime now, double found,
             const IsCovered& is_covered) {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (!entries_[i].on_ground_in_enu) {
        const Eigen::Vector2d place = frame.to_local(points_[i].position).position_in_enu;
        entries_[i].on_ground_in_enu = {place.x(), place.y(), ground.height_m(place)};
      }
      if (is_covered(*entries_[i].on_ground_in_enu)) look_at(entries_[i], now, found);
    }
  }

  /// Matches what is not matched yet. shared_sigma_m: 1-sigma per axis of the error that all candidates
  /// share. True where something new was matched.
  bool match(const std::vector<Candidate>& candidates, double shared_sigma_m, double gate, double ambiguity);

  /// Track `gone` is now called `kept`.
  void rename(std::uint64_t gone, std::uint64_t kept);

  /// A track is gone: its point is to be found again.
  void forget(std::uint64_t track_id);

  /// What is known of a track that is one of the points.
  std::optional<Survey> survey_of(std::uint64_t track_id) const;

  const std::vector<KnownPointMatch>& matches() const { return matches_; }

 private:
  struct Entry {
    std::optional<Eigen::Vector3d> on_ground_in_enu;  // once a frame was seen
    std::optional<VehicleTime> covered_at;            // last
    double unseen = 1.0;          // probability that no frame so far has shown the point's object
    std::uint64_t likely_id = 0;  // the track that was it, by the last solutions,
    int likely_for = 0;           // and for how many of them
  };

  static void look_at(Entry& entry, VehicleTime now, double found);
  void list_open();
  void add_pairings(std::size_t open, const std::vector<Candidate>& candidates, double shared_sigma_m);
  double density_of_others(std::size_t open, const std::vector<Candidate>& candidates,
                           double ambiguity) const;
  bool is_proven(Entry& entry, std::uint64_t track_id);
  KnownPointStatus status_of(const JointAssociation::Match& match, const Candidate* candidate,
                             double gate) const;
  double distance_squared(const JointAssociation::Match& match) const;
  double level_m() const;
  std::optional<std::size_t> point_of(std::uint64_t track_id) const;

  std::vector<KnownPoint> points_;
  std::vector<Entry> entries_;            // of the points
  std::vector<KnownPointMatch> matches_;  // of the points
  std::vector<std::size_t> open_;         // scratch: points to match
  JointAssociation association_;
};

}  // namespace geoloc
