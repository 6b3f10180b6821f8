// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "import/import_options.hpp"

namespace geoloc::apps {

/// Makes a recording of pictures; the program's exit status.
int import_stills(const StillsOptions& options);

}  // namespace geoloc::apps
