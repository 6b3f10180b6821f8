// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fuse/fuse_options.hpp"
#include "geoloc/fleet/object_ids.hpp"
#include "geoloc/io/output/run_record.hpp"
#include "geoloc/io/recording/recording.hpp"

namespace geoloc::apps {

/// The fleet's map as the outputs get it. Objects keep the ids that they have.
io::RunRecord fuse_to_run(const Fleet& fleet, const FuseOptions& options,
                          const std::vector<io::TrueTarget>& truth, ObjectIds& ids);

}  // namespace geoloc::apps
