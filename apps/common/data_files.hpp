// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace geoloc::apps {

/// A file that comes with geoloc (`models/fiducial.onnx`), looked for beside the program: in the source tree
/// it was built in, or in the share folder it was installed to. Throws std::runtime_error that says where it
/// looked.
std::filesystem::path find_data_file(const std::filesystem::path& name);

}  // namespace geoloc::apps
