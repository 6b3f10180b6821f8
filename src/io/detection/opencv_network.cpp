// SPDX-License-Identifier: Apache-2.0
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/core/version.hpp>
#include <opencv2/dnn.hpp>
#include <stdexcept>

#include "network.hpp"

namespace geoloc::io {
namespace {

/// Silences OpenCV's log: it logs what it throws, which is reported once in our words.
class QuietOpencv {
 public:
  QuietOpencv() : level_(cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT)) {}
  ~QuietOpencv() { cv::utils::logging::setLogLevel(level_); }
  QuietOpencv(const QuietOpencv&) = delete;
  QuietOpencv& operator=(const QuietOpencv&) = delete;

 private:
  cv::utils::logging::LogLevel level_;
};

/// OpenCV runs ultralytics' exports from 4.8 on. 4.6 fails on them and 4.7 on some. Both take a Split into
/// given sizes for one into equal parts (opencv/opencv#23482), which gives wrong results instead of an error.
constexpr bool kRunsExports = CV_VERSION_MAJOR > 4 || (CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR >= 8);

/// The remedy for an OpenCV that cannot run exports.
std::string conversion_of(const ModelFile& model) {
  const bool is_open = model.metadata.inputs.front().shape[2] == kUnknownLength;
  const std::string size = is_open ? " --input-size " + std::to_string(model.input.width_px) + " " +
                                         std::to_string(model.input.height_px)
                                   : "";
  return "convert it: python3 tools/onnx_for_opencv.py " + model.name.string() + " " +
         model.name.stem().string() + "_opencv.onnx" + size + " (of float16 models, export half=False), or ";
}

[[noreturn]] void fail(const ModelFile& model, const char* action, const std::string& reason) {
  refuse_model(model.name, "OpenCV " CV_VERSION " cannot " + std::string{action} + " this model of opset " +
                               std::to_string(model.metadata.opset) + " (" + one_line(reason) + "); " +
                               (kRunsExports ? "" : conversion_of(model)) +
                               "run it as it is with --backend openvino");
}

void check_splits(const ModelFile& model) {
  if (!kRunsExports && model.metadata.has_split_by_input)
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
  cv::Mat numbers_;  // of the input picture
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
