// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace geoloc {

/// The repository's root, which tests read files of. It is compiled into one file alone, so that the objects
/// of all others serve every clone (ccache).
std::filesystem::path source_tree();

/// tests/data there.
std::filesystem::path test_data();

}  // namespace geoloc
