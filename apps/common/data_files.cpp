// SPDX-License-Identifier: Apache-2.0
#include "common/data_files.hpp"

#include <stdexcept>
#include <string>

namespace geoloc::apps {

std::filesystem::path find_data_file(const std::filesystem::path& name) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path program_folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  std::string looked_in;
  for (const fs::path& folder : {program_folder / ".." / "share" / "geoloc",    // installed
                                 program_folder / ".." / ".." / ".." / "data",  // <source>/build/<preset>/bin
                                 fs::path("data")}) {                           // the source tree's root
    const fs::path candidate = (folder / name).lexically_normal();
    if (fs::exists(candidate)) return candidate;
    looked_in += "\n  " + candidate.string();
  }
  throw std::runtime_error(name.string() + " was not found. Looked for" + looked_in);
}

}  // namespace geoloc::apps
