// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "geoloc/io/output/object_report.hpp"

namespace geoloc::apps {

/// The objects as an aligned table with a header line.
std::string objects_to_table(const std::vector<io::ObjectReport>& objects);

}  // namespace geoloc::apps
