// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "geoloc/io/output/cot_config.hpp"
#include "geoloc/io/output/object_report.hpp"

namespace geoloc::io {

/// What an event says besides the object itself.
struct CotContext {
  std::string uid;
  HostTime sent_at;
  bool is_gone = false;  ///< the object is no longer believed in: out of date at once
  std::optional<double> height_msl_m;
  std::optional<double> height_ellipsoid_m;  ///< sent as unknown where it is
};

/// One CoT event (version 2.0, XML) of an object that has_place(). Less than 1400 bytes, whatever the class
/// is called, so that it fits a datagram.
std::string to_cot(const ObjectReport& object, const CotContext& context, const CotConfig& config);

}  // namespace geoloc::io
