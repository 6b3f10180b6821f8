// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/session.hpp"
#include "geoloc/io/output/run_record.hpp"
#include "geoloc/io/recording/recording.hpp"

namespace geoloc::apps {

/// The run so far, for files. `truth` may be empty.
io::RunRecord record_run(const Session& session, const std::vector<std::string>& class_names,
                         const std::vector<io::TrueTarget>& truth, const std::string& title);

/// Lines for a person: objects found and, where the truth is known, how well.
std::string summarize_run(const Session& session, const std::vector<io::TrueTarget>& truth);

}  // namespace geoloc::apps
