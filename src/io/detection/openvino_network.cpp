// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <openvino/core/preprocess/pre_post_process.hpp>
#include <openvino/runtime/core.hpp>
#include <openvino/runtime/properties.hpp>
#include <thread>

#include "geoloc/io/detection/yolo_detector.hpp"
#include "network.hpp"
#include "remedies.hpp"

namespace geoloc::io {
namespace {

void take_pictures(InputKind kind, ov::preprocess::PrePostProcessor& steps) {
  auto& tensor = steps.input().tensor().set_element_type(ov::element::u8).set_layout("NHWC");
  auto& preparation = steps.input().preprocess();
  if (kind == InputKind::kPicture) {
    tensor.set_color_format(ov::preprocess::ColorFormat::BGR);
    preparation.convert_color(ov::preprocess::ColorFormat::RGB);
  }
  preparation.convert_element_type(ov::element::f32);
  if (kind == InputKind::kPicture) preparation.scale(255.0F);
  steps.input().model().set_layout("NCHW");
}

/// What only other outputs need is then not computed.
void keep_only_output(std::size_t kept, ov::Model& model) {
  const ov::ResultVector results = model.get_results();
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (i != kept) model.remove_result(results[i]);
  }
}

/// The model with an input as the file's InputKind says and one output, of 32-bit floats, whatever its own
/// types.
std::shared_ptr<ov::Model> fitted_to(const ModelFile& file, const std::shared_ptr<ov::Model>& model) {
  model->reshape(ov::PartialShape{file.batch, 3, file.input.height_px, file.input.width_px});
  keep_only_output(file.output, *model);
  ov::preprocess::PrePostProcessor steps(model);
  if (file.kind != InputKind::kNumbers) take_pictures(file.kind, steps);
  if (file.kind == InputKind::kNumbers) steps.input().tensor().set_element_type(ov::element::f32);
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
  OpenvinoNetwork(const ModelFile& file, int threads) : kind_(file.kind) {
    const auto model = core_.read_model(std::string{file.bytes.begin(), file.bytes.end()}, ov::Tensor{});
    request_ =
        core_.compile_model(fitted_to(file, model), "CPU", settings_for(threads)).create_infer_request();
  }

  cv::Mat run(const cv::Mat& input) override {
    const cv::Mat whole = input.isContinuous() ? input : input.clone();
    request_.set_input_tensor(tensor_of(whole));
    request_.infer();
    ov::Tensor output = request_.get_output_tensor();
    std::vector<int> shape;
    for (const std::size_t length : output.get_shape()) shape.push_back(static_cast<int>(length));
    return cv::Mat{shape, CV_32F, output.data<float>()};
  }

 private:
  /// A tensor that shares the input's memory.
  ov::Tensor tensor_of(const cv::Mat& input) const {
    if (kind_ == InputKind::kNumbers)
      return {ov::element::f32, ov::Shape{input.size.p, input.size.p + input.dims}, input.data};
    const auto rows = static_cast<std::size_t>(input.rows), columns = static_cast<std::size_t>(input.cols);
    return {ov::element::u8, {1, rows, columns, 3}, input.data};
  }

  InputKind kind_;
  ov::Core core_;
  ov::InferRequest request_;
};

}  // namespace

std::unique_ptr<Network> load_with_openvino(const ModelFile& model, int threads) {
  try {
    return std::make_unique<OpenvinoNetwork>(model, threads);
  } catch (const std::exception& error) {
    refuse_model(model.name, "OpenVINO cannot load this model of opset " +
                                 std::to_string(model.metadata.opset) + " (" + one_line(error.what()) +
                                 "); " + remedy_for_openvino(model));
  }
}

bool has_openvino() {
  return true;
}

}  // namespace geoloc::io
