// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "byte_stream.hpp"
#include "geoloc/fleet/flight_summary.hpp"

// What makes a summary a part of a flight, as the last of its bytes before the checksum.
namespace geoloc::io {

void put_part(const FlightSummary::Part& part, ByteWriter& writer);
FlightSummary::Part take_part(const std::string& name, ByteReader& reader);

}  // namespace geoloc::io
