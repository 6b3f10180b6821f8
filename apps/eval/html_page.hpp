// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "eval/eval_results.hpp"
#include "eval/report_context.hpp"

namespace geoloc::apps {

/// Everything on one page that needs nothing else: no network, no scripts. For telephones and large screens,
/// light and dark.
std::string to_html(const EvalResults& results, const ReportContext& context);

}  // namespace geoloc::apps
