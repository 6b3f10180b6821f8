// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "geoloc/io/output/estimator_report.hpp"
#include "geoloc/io/output/object_report.hpp"

namespace geoloc::io {

/// The FeatureCollection of docs/formats.md (RFC 7946): one Point per object, and the run's method and
/// counters.
std::string objects_to_geojson(const std::vector<ObjectReport>& objects, const EstimatorReport& estimator);

}  // namespace geoloc::io
