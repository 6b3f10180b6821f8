// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "../embedded_file.hpp"

namespace geoloc::io {

/// The files of src/io/live_page/page.
const std::vector<EmbeddedFile>& page_files();

}  // namespace geoloc::io
