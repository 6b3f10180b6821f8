// SPDX-License-Identifier: Apache-2.0
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/core/version.hpp>
#include <opencv2/dnn.hpp>
#include <stdexcept>

#include "network.hpp"

namespace geoloc::io {
namespace {

/// OpenCV logs what it throws; here that is told once, in our words.
class QuietOpencv {
 public:
  QuietOpencv() : level_(cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT)) {}
  ~QuietOpencv() { cv::utils::logging::setLogLevel(level_); }
  QuietOpencv(const QuietOpencv&) = delete;
  QuietOpencv& operator=(const QuietOpencv&) = delete;

 private:
  cv::utils::logging::LogLevel level_;
};

[[noreturn]] void fail(const ModelFile& model, const char* action, const std::string& reason) {
  const std::string name = model.name.string();
  const bool is_open = model.metadata.inputs.front().shape[2] == kUnknownLength;
  const std::string size = is_open ? " --input-size " + std::to_string(model.input.width_px) + " " +
                                         std::to_string(model.input.height_px)
                                   : "";
  refuse_model(model.name, "OpenCV " CV_VERSION " cannot " + std::string{action} + " this model of opset " +
                               std::to_string(model.metadata.opset) + " (" + one_line(reason) +
                               "); convert it: python3 tools/onnx_for_opencv.py " + name + " " +
                               model.name.stem().string() + "_opencv.onnx" + size +
                               " (of float16 models, export half=False), or run it as it is with --backend "
                               "openvino");
}

/// Before 4.8 (opencv/opencv#23482), OpenCV ignores the sizes and splits into equal parts: wrong results, not
/// an error.
void check_splits(const ModelFile& model) {
  constexpr bool kIgnoresSizes = CV_VERSION_MAJOR < 4 || (CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR < 8);
  if (kIgnoresSizes && model.metadata.has_split_by_input)
    fail(model, "run", "it does not know Split as of opset 13");
}

class OpencvNetwork final : public Network {
 public:
  explicit OpencvNetwork(const ModelFile& model)
      : net_(cv::dnn::readNetFromONNX(model.bytes.data(), model.bytes.size())), kind_(model.kind) {}

  cv::Mat run(const cv::Mat& input) override {
    constexpr bool kSwapRedAndBlue = true;
    if (kind_ == InputKind::kPicture)
      cv::dnn::blobFromImage(input, numbers_, 1.0 / 255.0, {}, {}, kSwapRedAndBlue);
    net_.setInput(kind_ == InputKind::kPicture ? numbers_ : input);
    return net_.forward();
  }

 private:
  cv::dnn::Net net_;
  InputKind kind_;
  cv::Mat numbers_;  // of the picture
};

}  // namespace

std::unique_ptr<Network> load_with_opencv(const ModelFile& model) {
  check_splits(model);
  const QuietOpencv quiet;
  const char* action = "load";
  try {
    auto network = std::make_unique<OpencvNetwork>(model);
    action = "run";
    network->run(plain_input(model));
    return network;
  } catch (const cv::Exception& error) {
    fail(model, action, error.err);
  } catch (const std::exception& error) {
    fail(model, action, error.what());
  }
}

}  // namespace geoloc::io
