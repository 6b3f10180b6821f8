// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "fleet/fusion_input.hpp"
#include "fleet/map_solver.hpp"

namespace geoloc {

/// Makes one of neighbours on the map that are one object: they lie where one object would by what each
/// flight knows of them by itself, and no flight saw them side by side. Two objects of one part that were
/// never in a frame together are compared more strictly, since the run did not take them for one. Whether
/// there were any.
bool merge_neighbours(const FusionInput& input, const MapEstimate& estimate, const FusionConfig& config,
                      std::vector<Members>& objects);

}  // namespace geoloc
