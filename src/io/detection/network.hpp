// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/io/detection/detection_config.hpp"
#include "geoloc/io/detection/letterbox.hpp"
#include "geoloc/io/detection/yolo_decode.hpp"
#include "model_file.hpp"

namespace geoloc::io {

/// What YOLO networks are trained to see as no picture.
inline const cv::Scalar kLetterboxGrey = cv::Scalar::all(114);

/// A network in the hands of a back end.
class Network {
 public:
  virtual ~Network() = default;

  /// `bgr`: 8 bits, 3 channels, of the size of the network's input. The output, 32-bit floats, stays valid
  /// until the next call. Throws std::exception where the back end fails.
  virtual cv::Mat run(const cv::Mat& bgr) = 0;

 protected:
  Network() = default;
  Network(const Network&) = default;
  Network& operator=(const Network&) = default;
};

/// Each throws std::runtime_error naming the file, the fault and the remedy.
std::unique_ptr<Network> load_with_opencv(const ModelFile& model);
std::unique_ptr<Network> load_with_openvino(const ModelFile& model, int threads);

/// A detection network that was loaded, run once and found to be one.
struct DetectionNetwork {
  std::unique_ptr<Network> network;
  ImageSize input;
  int classes = 0;
  int candidates = 0;
  std::optional<std::vector<std::string>> class_names;  ///< as the file has them
  std::optional<CentreSigma> centre_sigma;              ///< likewise
};

/// Throws std::runtime_error naming the file, the fault and the remedy.
DetectionNetwork load_network(const std::filesystem::path& file, const DetectionConfig& config);

}  // namespace geoloc::io
