// SPDX-License-Identifier: Apache-2.0
#include <stdexcept>

#include "geoloc/io/detection/yolo_detector.hpp"
#include "network.hpp"

namespace geoloc::io {

std::unique_ptr<Network> load_with_openvino(const ModelFile& /*model*/, int /*threads*/) {
  throw std::runtime_error(
      "geoloc was built without OpenVINO: bash scripts/openvino.sh installs it, then configure and build "
      "again");
}

bool has_openvino() {
  return false;
}

}  // namespace geoloc::io
