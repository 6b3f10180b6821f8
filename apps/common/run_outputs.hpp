// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/session.hpp"
#include "geoloc/evaluation/score.hpp"
#include "geoloc/io/output/object_report.hpp"
#include "geoloc/io/output/run_record.hpp"
#include "geoloc/io/recording/recording.hpp"

namespace geoloc::apps {

/// The run so far, for files. `truth` may be empty.
io::RunRecord record_run(const Session& session, const std::vector<std::string>& class_names,
                         const std::vector<io::TrueTarget>& truth, const std::string& title);

/// Objects that are not scored, by id: those whose places the run was told.
using LeftOut = std::vector<std::uint64_t>;

/// The run against the true targets.
Score score_run(const Session& session, const std::vector<io::TrueTarget>& truth,
                const LeftOut& left_out = {});

/// Of the objects that score matched (score.hpp).
double consistency_of_run(const Session& session, const std::vector<io::TrueTarget>& truth,
                          const Score& score, const LeftOut& left_out = {});

/// Lines for a person: objects found and, where the truth is known, how well.
std::string summarize(const Session& session, const std::vector<io::TrueTarget>& truth);

/// The objects as an aligned table with a header line.
std::string objects_to_table(const std::vector<io::ObjectReport>& objects);

}  // namespace geoloc::apps
