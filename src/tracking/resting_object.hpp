// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>

#include "calibration/landmark.hpp"
#include "calibration/settled_sums.hpp"
#include "calibration/shared_error_estimate.hpp"
#include "tracking/tracked_object.hpp"

namespace geoloc {

/// Sums over looks at a track that came while another, younger one beside it was seen too: drawn to one side,
/// they tell that the track was made of looks at both.
struct Mixture {
  int looks = 0;
  Eigen::Vector2d sum_of_innovations = Eigen::Vector2d::Zero();
  double sum_of_noise = 0.0;  ///< traces [m^2]
};

/// A look as it is in an object's sums, on which much of what is known of the object hangs.
struct DecisiveLook {
  LandmarkObservation observation;
  Eigen::Matrix2d noise;  ///< of it by itself [m^2]
  Eigen::Matrix2d pixel_noise;
  double one_per_image;  ///< density of one point in its image, on the ground there [1/m^2]
  int hits;              ///< of the object, with it
};

/// An object at rest.
struct RestingObject : TrackedObject {
  Landmark* landmark = nullptr;  ///< sums over its looks; the table's
  Mixture mixture;
  bool is_compared = false;               ///< with the others, since it can be
  bool is_known = false;                  ///< its surveyed place is in the sums
  bool is_settled = false;                ///< C and g of its earlier looks are in the SettledSums
  VehicleTime last_near{};                ///< when a frame might have shown it, if only just
  std::size_t published_at = 0;           ///< its place among the PublishedTracks, as far as is known
  PointInformation prior;                 ///< by the ground, and by a survey; in the sums
  PointInformation ground;                ///< that of the ground alone
  Point position_in_enu = Point::Zero();  ///< up: above the level ground [m]
  double sigma_height_m = 0.0;
  VehicleTime sums_since{};                             ///< earlier looks are not in the sums
  std::optional<DecisiveLook> first_look;               ///< in the sums
  std::optional<DecisiveLook> height_look;              ///< in the sums: by it the height became known
  PointMatrix pixel_information = PointMatrix::Zero();  ///< sum of the looks' and the ground's [1/m^2]
  PointMatrix pixel_covariance = PointMatrix::Zero();   ///< its inverse [m^2]
  PointMatrix own_covariance = PointMatrix::Zero();     ///< A^-1 [m^2]
  Point weighted_position = Point::Zero();              ///< A x [1/m]
  /// d position / d shared error of the next looks, whitened [m].
  SharedError::PointRow sensitivity = SharedError::PointRow::Zero();

  // The present frame's evidence.
  std::optional<std::size_t> look;     ///< that shows it, and nothing else
  bool is_in_doubt = false;            ///< perhaps seen: no conclusion
  double detection_probability = 0.0;  ///< by this frame; 0 where it should not show the object
};

/// Position and its derivatives from the sums; `now`: the drift nodes of the present frame.
void refresh(RestingObject& object, const SharedErrorEstimate& errors, const NodeSpan& now);

/// Whether any look is in the sums.
bool has_looks(const RestingObject& object);

/// The look shows the object; refresh() is the caller's.
void add_look(RestingObject& object, const Look& look, const DriftTimeline& drift);

/// Undoes add_look() for a look of that observation and noise.
void take_out_look(RestingObject& object, const LandmarkObservation& observation,
                   const Eigen::Matrix2d& pixel_noise, const DriftTimeline& drift);

/// The look shows the object.
void add_to_sums(RestingObject& object, const Look& look, const SharedErrorEstimate& errors);

/// The object is known from this look and its prior alone.
void begin_sums(RestingObject& object, const Look& look, const SharedErrorEstimate& errors);

/// No look is in the sums.
void clear_sums(RestingObject& object);

/// Its sums are about to be forgotten. What looks told of the head before they were settled stays.
void leave_settled(RestingObject& object, SettledSums& settled);

/// The ground at the object's place says this, and no longer what it said before.
void set_ground(RestingObject& object, const PointInformation& ground);

/// More is known of the object from elsewhere.
void add_prior(RestingObject& object, const PointInformation& prior);

/// The looks of both are looks at one object. At most one of them is a known point.
void merge_sums(RestingObject& kept, const RestingObject& gone, const DriftTimeline& drift);

}  // namespace geoloc
