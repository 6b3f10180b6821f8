// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "geoloc/fleet/object_ids.hpp"
#include "geoloc/io/output/run_record.hpp"

// Rows of a fleet's tables as JSON, for jsonb_to_recordset(): the database needs no other escaping.
namespace geoloc::io {

std::string rows_of_flights(const RunRecord& run);

/// Of those that have a place.
std::string rows_of_objects(const RunRecord& run);

std::string rows_of_ids(const ObjectIds& ids);

}  // namespace geoloc::io
