// SPDX-License-Identifier: Apache-2.0
#include "common/data_files.hpp"

#include <array>
#include <stdexcept>
#include <string>

namespace geoloc::apps {
namespace {

namespace fs = std::filesystem;

std::array<fs::path, 3> candidates_of(const fs::path& name) {
  std::error_code error;
  const fs::path program_folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  return {(program_folder / ".." / "share" / "geoloc" / name).lexically_normal(),  // installed, or built
          (program_folder / ".." / ".." / ".." / "data" / name)
              .lexically_normal(),   // <source>/build/<preset>/bin
          fs::path("data") / name};  // the source tree's root
}

}  // namespace

std::optional<fs::path> look_for_data(const fs::path& name) {
  for (const fs::path& candidate : candidates_of(name)) {
    if (fs::exists(candidate)) return candidate;
  }
  return std::nullopt;
}

fs::path find_data(const fs::path& name) {
  if (const auto found = look_for_data(name)) return *found;
  std::string looked_in;
  for (const fs::path& candidate : candidates_of(name)) looked_in += "\n  " + candidate.string();
  throw std::runtime_error(name.string() + " was not found. Looked for" + looked_in);
}

}  // namespace geoloc::apps
