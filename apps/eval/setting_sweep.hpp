// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/estimation_config.hpp"
#include "eval/sweep.hpp"

namespace geoloc::apps {

/// The sweep of --sweep-setting: `PATH=a,b,c` varies a setting of the estimator that is a number, over
/// `config`. Throws std::runtime_error that says what is wrong with the path or which values are refused.
Sweep setting_sweep(const std::string& text, const EstimationConfig& config);

}  // namespace geoloc::apps
