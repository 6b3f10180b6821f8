// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "geoloc/io/output/object_report.hpp"

namespace geoloc::io {

/// RFC 4180 with a header line and one line per object; docs/formats.md lists the columns. Objects without a
/// finite position are left out; other numbers that are not finite are empty.
std::string objects_to_csv(const std::vector<ObjectReport>& objects);

/// A text as one field, quoted if necessary. Anything that a spreadsheet would take for a formula gets a
/// leading apostrophe.
std::string csv_field(const std::string& text);

}  // namespace geoloc::io
