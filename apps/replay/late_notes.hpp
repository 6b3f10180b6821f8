// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/estimation_config.hpp"
#include "common/output_options.hpp"
#include "common/outputs.hpp"
#include "geoloc/io/output/run_record.hpp"

// Notes that people make of objects while a recording is replayed. Messages go to stderr.
namespace geoloc::apps {

/// Keeps in the recording what was noted since the last call. Whether there was anything.
bool keep_notes(const std::string& recording, const Outputs& outputs);

/// Writes the files of objects again, which were written before the last notes. False where that failed.
bool write_noted_objects(const OutputOptions& options, const EstimationConfig& config,
                         const std::vector<std::string>& class_names, const Outputs& outputs,
                         io::RunRecord record);

}  // namespace geoloc::apps
