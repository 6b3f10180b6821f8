// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "geoloc/io/output/cot_config.hpp"
#include "geoloc/io/output/output_frame.hpp"

namespace geoloc::io {

/// What the events of a view say besides.
struct CotViewContext {
  std::string uid;  ///< of the run: the vehicle's and the point's begin with it
  HostTime captured_at;
  HostTime sent_at;
  std::optional<double> home_ellipsoid_m;  ///< height of home above the WGS84 ellipsoid
};

/// The vehicle as a CoT event with its camera as `<sensor>`, which TAK draws as a field of view.
std::string vehicle_to_cot(const ViewReport& view, const CotViewContext& context, const CotConfig& config);

/// The ground at the image's centre as the sensor's point of interest; empty where the image's centre is not
/// on the ground.
std::string point_of_interest_to_cot(const ViewReport& view, const CotViewContext& context,
                                     const CotConfig& config);

}  // namespace geoloc::io
