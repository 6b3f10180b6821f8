// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "geoloc/io/output/cot_config.hpp"
#include "geoloc/io/output/object_report.hpp"

namespace geoloc::io {

/// The protocol's value for figures that are not known.
inline constexpr double kCotUnknown = 9999999.0;

/// The content of an event besides the object itself.
struct CotContext {
  std::string uid;
  HostTime sent_at;
  bool is_gone = false;  ///< the object is no longer believed to exist: the event is stale at once
};

/// One CoT event (version 2.0, XML) of an object that has_place(). It is shorter than 1400 bytes, whatever
/// the class name, so that it fits into a datagram.
std::string to_cot(const ObjectReport& object, const CotContext& context, const CotConfig& config);

}  // namespace geoloc::io
