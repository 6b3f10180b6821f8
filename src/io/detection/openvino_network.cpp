// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <openvino/core/preprocess/pre_post_process.hpp>
#include <openvino/runtime/core.hpp>
#include <openvino/runtime/properties.hpp>
#include <thread>

#include "geoloc/io/detection/yolo_detector.hpp"
#include "network.hpp"

namespace geoloc::io {
namespace {

/// The model between 8-bit BGR pictures and 32-bit floats, whatever its own types.
std::shared_ptr<ov::Model> with_pictures(const std::shared_ptr<ov::Model>& model, ImageSize input) {
  model->reshape(ov::PartialShape{1, 3, input.height_px, input.width_px});
  ov::preprocess::PrePostProcessor steps(model);
  steps.input()
      .tensor()
      .set_element_type(ov::element::u8)
      .set_layout("NHWC")
      .set_color_format(ov::preprocess::ColorFormat::BGR);
  steps.input()
      .preprocess()
      .convert_color(ov::preprocess::ColorFormat::RGB)
      .convert_element_type(ov::element::f32)
      .scale(255.0F);
  steps.input().model().set_layout("NCHW");
  steps.output().tensor().set_element_type(ov::element::f32);
  return steps.build();
}

/// Single precision, so that it gives the boxes that OpenCV gives; no thread tied to a core, because the
/// video decoder and the estimator need them too.
ov::AnyMap settings_for(int threads) {
  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  return {ov::hint::performance_mode(ov::hint::PerformanceMode::LATENCY),
          ov::hint::inference_precision(ov::element::f32),
          ov::inference_num_threads(threads > 0 ? threads : cores), ov::hint::enable_cpu_pinning(false)};
}

class OpenvinoNetwork final : public Network {
 public:
  OpenvinoNetwork(const ModelFile& file, int threads) {
    const auto model = core_.read_model(std::string{file.bytes.begin(), file.bytes.end()}, ov::Tensor{});
    request_ = core_.compile_model(with_pictures(model, file.input), "CPU", settings_for(threads))
                   .create_infer_request();
  }

  cv::Mat run(const cv::Mat& bgr) override {
    const auto rows = static_cast<std::size_t>(bgr.rows), columns = static_cast<std::size_t>(bgr.cols);
    const cv::Mat whole = bgr.isContinuous() ? bgr : bgr.clone();
    request_.set_input_tensor(ov::Tensor{ov::element::u8, {1, rows, columns, 3}, whole.data});
    request_.infer();
    ov::Tensor output = request_.get_output_tensor();
    std::vector<int> shape;
    for (const std::size_t length : output.get_shape()) shape.push_back(static_cast<int>(length));
    return cv::Mat{shape, CV_32F, output.data<float>()};
  }

 private:
  ov::Core core_;
  ov::InferRequest request_;
};

}  // namespace

std::unique_ptr<Network> load_with_openvino(const ModelFile& model, int threads) {
  try {
    return std::make_unique<OpenvinoNetwork>(model, threads);
  } catch (const std::exception& error) {
    refuse_model(model.name, "OpenVINO cannot load this model of opset " +
                                 std::to_string(model.metadata.opset) + " (" + one_line(error.what()) + ")");
  }
}

bool has_openvino() {
  return true;
}

}  // namespace geoloc::io
