// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "calibration/shared_error_estimate.hpp"
#include "tracking/joint_association.hpp"
#include "tracking/look.hpp"
#include "tracking/resting_object.hpp"

namespace geoloc {

/// Whether the look lies so far from where its object should be seen that what either says of the shared
/// errors is another thing: in a turn, say, where a late frame moves each of them in its own direction.
bool is_far(const Look& look, const JointAssociation::Match& match);

/// Whether a look agrees with the object where that should be seen (`observation` is linearised there). gate:
/// squared Mahalanobis distance.
bool agrees(const LandmarkObservation& observation, const RestingObject& object, double gate,
            const SharedErrorEstimate& errors);

/// How much more probable a look was nothing than the object, before it is compared with the object's others.
struct FalseOdds {
  double of_first;  ///< of a look that fits no known object
  double of_later;  ///< of a look at an object: false boxes in the image, by those that show the object
};

/// Takes a look out of a young object's sums that a false box explains better than the object does, once its
/// other looks tell where it is. (While the height of an object is open, looks metres away along its ray join
/// it, and what one of them says of the height stays.) Where the sums hold the look as it was no more, they
/// begin anew with the newest one. Returns the look that was taken out, if there is one.
std::optional<DecisiveLook> drop_false_looks(RestingObject& object, const Look& newest, const FalseOdds& odds,
                                             const SharedErrorEstimate& errors);

}  // namespace geoloc
