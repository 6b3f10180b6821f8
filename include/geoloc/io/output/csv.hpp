// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "geoloc/io/output/object_report.hpp"

namespace geoloc::io {

/// RFC 4180 with a header line, a line for each object: docs/formats.md names the columns. Objects without a
/// finite place are left out, other figures that are not finite are empty.
std::string objects_to_csv(const std::vector<ObjectReport>& objects);

/// A text as one field: quoted where it must be. What a spreadsheet would take for a formula gets an
/// apostrophe in front.
std::string csv_field(const std::string& text);

}  // namespace geoloc::io
