// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "geoloc/io/live_page/live_document.hpp"

namespace geoloc::io {

inline constexpr const char* kMetricsType = "text/plain; version=0.0.4; charset=utf-8";

/// The run's figures as Prometheus reads them: docs/live_page.md lists them.
std::string metrics_text(const RunFigures& figures);

}  // namespace geoloc::io
