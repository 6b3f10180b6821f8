// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/core/version.hpp>
#include <opencv2/dnn.hpp>
#include <stdexcept>

#include "network.hpp"
#include "remedies.hpp"

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

[[noreturn]] void fail(const ModelFile& model, const char* action, const std::string& reason) {
  refuse_model(model.name, "OpenCV " CV_VERSION " cannot " + std::string{action} + " this model of opset " +
                               std::to_string(model.metadata.opset) + " (" + one_line(reason) + "); " +
                               remedy_for_opencv(model));
}

/// The name of the output that lists boxes where there are several: OpenCV does not keep their order.
cv::String output_of_boxes(cv::dnn::Net& net) {
  const std::vector<cv::String> names = net.getUnconnectedOutLayersNames();
  std::vector<cv::Mat> outputs;
  net.forward(outputs, names);
  const auto is_list = [](const cv::Mat& output) { return output.dims == 3; };
  const auto found = std::find_if(outputs.begin(), outputs.end(), is_list);
  if (found == outputs.end()) throw std::runtime_error("no output lists boxes");
  return names.at(static_cast<std::size_t>(found - outputs.begin()));
}

class OpencvNetwork final : public Network {
 public:
  explicit OpencvNetwork(const ModelFile& model)
      : net_(cv::dnn::readNetFromONNX(model.bytes.data(), model.bytes.size())), kind_(model.kind) {
    if (model.metadata.outputs.size() == 1) return;
    set_input(plain_input(model));
    output_ = output_of_boxes(net_);
  }

  cv::Mat run(const cv::Mat& input) override {
    set_input(input);
    return net_.forward(output_);
  }

 private:
  void set_input(const cv::Mat& input) {
    const bool is_rgb = kind_ == InputKind::kPicture;
    if (kind_ == InputKind::kNumbers) return net_.setInput(input);
    cv::dnn::blobFromImage(input, numbers_, is_rgb ? 1.0 / 255.0 : 1.0, {}, {}, is_rgb);
    net_.setInput(numbers_);
  }

  cv::dnn::Net net_;
  InputKind kind_;
  cv::String output_;  // empty: the only one
  cv::Mat numbers_;    // of the input picture
};

}  // namespace

std::unique_ptr<Network> load_with_opencv(const ModelFile& model) {
  refuse_what_opencv_mistakes(model);
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
