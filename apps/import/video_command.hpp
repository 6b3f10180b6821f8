// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "import/import_options.hpp"

namespace geoloc::apps {

/// Makes a recording of a video and the log beside it; the program's exit status.
int import_video(const VideoOptions& options);

}  // namespace geoloc::apps
