// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

namespace geoloc::apps {

/// A file or folder that comes with geoloc (`models/fiducial.onnx`), looked for beside the program: in the
/// build or the source tree it was built in, or in the share folder it was installed to. nullopt where it is
/// not there.
std::optional<std::filesystem::path> look_for_data(const std::filesystem::path& name);

/// The same; throws std::runtime_error that says where it looked.
std::filesystem::path find_data(const std::filesystem::path& name);

}  // namespace geoloc::apps
