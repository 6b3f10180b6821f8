// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace geoloc::io {

/// A text file of the source tree that was built into the program (geoloc_embed_files()).
struct EmbeddedFile {
  std::string_view name;
  std::string_view content;
};

}  // namespace geoloc::io
