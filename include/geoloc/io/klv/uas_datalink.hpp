// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "geoloc/io/output/output_frame.hpp"

namespace geoloc::io {

/// What a frame shows, and from where, as a UAS Datalink Local Set (MISB ST 0601.17, docs/formats.md). The
/// precision time stamp is the capture time in microseconds of UNIX. What is unknown, not finite, or beyond
/// what an item can tell is left out; a frame that was not located has its time alone.
std::string uas_datalink_set(const OutputFrame& frame);

}  // namespace geoloc::io
