// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>

#include "calibration/landmark.hpp"
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

/// An object at rest.
struct RestingObject : TrackedObject {
  Landmark* landmark = nullptr;  ///< sums over its looks; the table's
  Mixture mixture;
  bool is_compared = false;                                     ///< with the others, since it can be
  bool is_known = false;                                        ///< its surveyed place is in the sums
  Eigen::Matrix2d pixel_information = Eigen::Matrix2d::Zero();  ///< sum of the looks' [1/m^2]
  Eigen::Matrix2d own_covariance = Eigen::Matrix2d::Zero();     ///< A^-1 [m^2]

  // The present frame's evidence.
  std::optional<std::size_t> look;     ///< that shows it, and nothing else
  bool is_in_doubt = false;            ///< perhaps seen: no conclusion
  double detection_probability = 0.0;  ///< by this frame; 0 where it should not show the object
};

/// Position and its derivatives from the sums; `now`: the drift nodes of the present frame.
void refresh(RestingObject& object, const SharedErrorEstimate& errors, const NodeSpan& now);

/// The look shows the object.
void add_to_sums(RestingObject& object, const Look& look, const SharedErrorEstimate& errors);

/// The object is known from this look alone.
void begin_sums(RestingObject& object, const Look& look, const SharedErrorEstimate& errors);

}  // namespace geoloc
