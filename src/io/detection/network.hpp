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

/// The grey that YOLO networks are trained to see as outside of the picture.
inline const cv::Scalar kLetterboxGrey = cv::Scalar::all(114);

/// A network loaded by a back end.
class Network {
 public:
  virtual ~Network() = default;

  /// `input`: of the model's InputKind and of the size of its input; numbers as [batch, 3, height, width].
  /// The output, 32-bit floats, stays valid until the next call. Throws std::exception if the back end fails.
  virtual cv::Mat run(const cv::Mat& input) = 0;

 protected:
  Network() = default;
  Network(const Network&) = default;
  Network& operator=(const Network&) = default;
};

/// Each throws std::runtime_error naming the file, the fault and the remedy.
std::unique_ptr<Network> load_with_opencv(const ModelFile& model);
std::unique_ptr<Network> load_with_openvino(const ModelFile& model, int threads);

/// A detection network that was loaded, checked and run once.
struct DetectionNetwork {
  std::unique_ptr<Network> network;
  ImageSize input;
  OutputForm form;
  std::optional<std::vector<std::string>> class_names;  ///< as the file has them
  std::optional<CentreSigma> centre_sigma;              ///< likewise
};

/// `named_classes`: how many names are given besides those in the file. Throws std::runtime_error naming the
/// file, the fault and the remedy.
DetectionNetwork load_network(const std::filesystem::path& file, std::optional<int> named_classes,
                              const DetectionConfig& config);

/// A network for second looks (second_look.hpp), likewise.
struct SecondLookNetwork {
  std::unique_ptr<Network> network;
  int batch = 0;     ///< patches it takes at once
  int patch_px = 0;  ///< side of a patch
};

SecondLookNetwork load_second_look(const std::filesystem::path& file, const DetectionConfig& config);

/// An input to try a model with before there is a picture: plain grey, or zeros.
cv::Mat plain_input(const ModelFile& model);

}  // namespace geoloc::io
