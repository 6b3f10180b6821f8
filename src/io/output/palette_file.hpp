// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "../embedded_file.hpp"

namespace geoloc::io {

/// palette.css alone.
const std::vector<EmbeddedFile>& palette_files();

}  // namespace geoloc::io
