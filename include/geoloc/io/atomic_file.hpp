// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

#include "geoloc/io/partial_file.hpp"

namespace geoloc::io {

/// Writes the file under a temporary name beside its own and renames it: readers see either the old content
/// or the new. Links are followed; devices, pipes and sockets are written to directly. Throws
/// std::runtime_error naming the file and the system's reason.
inline void write_file_atomically(const std::filesystem::path& file, std::string_view content) {
  PartialFile partial(file);
  write_to(file, [&] {
    OutputStream output = partial.open();
    output.write(content);
    output.close();
  });
  partial.commit();
}

}  // namespace geoloc::io
