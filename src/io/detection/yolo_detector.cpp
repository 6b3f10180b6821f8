// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/detection/yolo_detector.hpp"

#include <algorithm>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <utility>

#include "geoloc/geometry/refuse.hpp"
#include "geoloc/io/detection/yolo_decode.hpp"
#include "network.hpp"
#include "picture.hpp"

namespace geoloc::io {
namespace {

std::optional<std::vector<std::string>> given_names(const DetectorFiles& files) {
  return files.class_names ? std::optional{read_class_names(*files.class_names)} : std::nullopt;
}

std::vector<std::string> names_for(const DetectorFiles& files, const DetectionNetwork& network) {
  const auto classes = static_cast<std::size_t>(network.form.classes);
  if (auto names = given_names(files)) {
    if (names->size() == classes) return *names;
    throw std::runtime_error(files.class_names->string() + ": has " + std::to_string(names->size()) +
                             " names; " + files.model.string() + " has " + std::to_string(classes) +
                             " classes");
  }
  if (network.class_names) return *network.class_names;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < classes; ++i) names.push_back("class " + std::to_string(i));
  return names;
}

DetectionConfig checked(const DetectorFiles& files, const DetectionConfig& config) {
  refuse_if_any(config.problems());
  return with_model_defaults(files, config);
}

/// RT-DETR is trained on pictures that fill its input, whatever their aspect ratio.
Letterbox placement(ImageSize picture, ImageSize input, OutputLayout layout) {
  const bool is_stretched = layout == OutputLayout::kRtdetr || layout == OutputLayout::kRtdetrTop;
  return is_stretched ? stretch_to(picture, input) : fit_letterbox(picture, input);
}

}  // namespace

class YoloDetector::Impl {
 public:
  Impl(const DetectorFiles& files, const DetectionConfig& config) : config_(checked(files, config)) {
    if (config_.backend == Backend::kOpencv && config_.threads > 0) cv::setNumThreads(config_.threads);
    const auto names = given_names(files);
    network_ = load_network(files.model,
                            names ? std::optional{static_cast<int>(names->size())} : std::nullopt, config_);
    class_names_ = names_for(files, network_);
    canvas_ = cv::Mat{network_.input.height_px, network_.input.width_px, CV_8UC3, kLetterboxGrey};
  }

  std::vector<Detection> detect(const cv::Mat& picture) {
    ++counts_.images;
    try {
      const cv::Mat bgr = as_bgr(picture);
      if (!bgr.empty()) return detect_in_bgr(bgr);
      ++counts_.unusable_images;
    } catch (const std::exception&) {  // cv::Exception, ov::Exception, or no memory
      ++counts_.failed_images;
    }
    return {};
  }

  const std::vector<std::string>& class_names() const { return class_names_; }
  const DetectorCounts& counts() const { return counts_; }
  ImageSize input_size() const { return network_.input; }

 private:
  std::vector<Detection> detect_in_bgr(const cv::Mat& bgr) {
    const ImageSize size{bgr.cols, bgr.rows};
    const Letterbox letterbox = placement(size, network_.input, network_.form.layout);
    fill_canvas(bgr, letterbox);
    const cv::Mat output = network_.network->run(canvas_);
    const OutputForm& form = network_.form;
    if (output.total() != static_cast<std::size_t>(form.candidates) * static_cast<std::size_t>(form.values))
      throw std::runtime_error("the output changed its size");
    const DecodedBoxes decoded = decode_yolo({output.ptr<float>(), form}, letterbox, network_.input, size,
                                             config_, network_.centre_sigma);
    counts_.rejected_boxes += decoded.rejected;
    counts_.best_score_below = std::max(counts_.best_score_below, decoded.best_score_below);
    return decoded.detections;
  }

  void fill_canvas(const cv::Mat& bgr, const Letterbox& letterbox) {
    const cv::Rect place{letterbox.left_px, letterbox.top_px, letterbox.scaled.width_px,
                         letterbox.scaled.height_px};
    if (place != place_) canvas_.setTo(kLetterboxGrey);
    place_ = place;
    cv::Mat target = canvas_(place);
    cv::resize(bgr, target, target.size(), 0, 0, cv::INTER_LINEAR);
  }

  const DetectionConfig config_;
  DetectionNetwork network_;
  std::vector<std::string> class_names_;
  DetectorCounts counts_;
  cv::Mat canvas_;  // the letterboxed picture
  cv::Rect place_;  // of the picture in it
};

DetectionConfig with_model_defaults(const DetectorFiles& files, DetectionConfig config) {
  if (config.confidence > 0.0) return config;
  const auto properties = read_model_metadata(files.model).properties;
  const auto first = properties.lower_bound(kOurKeys);
  const bool is_ours = first != properties.end() && first->first.rfind(kOurKeys, 0) == 0;
  config.confidence = is_ours ? kConfidenceOfOurModels : kConfidenceOfOtherModels;
  return config;
}

YoloDetector::YoloDetector(const DetectorFiles& files, const DetectionConfig& config)
    : impl_(std::make_unique<Impl>(files, config)) {}

YoloDetector::~YoloDetector() = default;

std::vector<Detection> YoloDetector::detect(const cv::Mat& bgr) {
  return impl_->detect(bgr);
}

const std::vector<std::string>& YoloDetector::class_names() const {
  return impl_->class_names();
}

DetectorCounts YoloDetector::counts() const {
  return impl_->counts();
}

ImageSize YoloDetector::input_size() const {
  return impl_->input_size();
}

}  // namespace geoloc::io
