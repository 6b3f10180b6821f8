// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/detection/yolo_detector.hpp"

#include <algorithm>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <utility>

#include "geoloc/geometry/problems.hpp"
#include "geoloc/io/detection/yolo_decode.hpp"
#include "network.hpp"
#include "picture.hpp"

namespace geoloc::io {
namespace {

std::vector<std::string> names_for(const DetectorFiles& files, const DetectionNetwork& network) {
  const auto classes = static_cast<std::size_t>(network.classes);
  if (files.class_names) {
    auto names = read_class_names(*files.class_names);
    if (names.size() == classes) return names;
    throw std::runtime_error(files.class_names->string() + ": has " + std::to_string(names.size()) +
                             " names; " + files.model.string() + " has " + std::to_string(classes) +
                             " classes");
  }
  if (network.class_names) return *network.class_names;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < classes; ++i) names.push_back("class " + std::to_string(i));
  return names;
}

DetectionConfig checked(const DetectionConfig& config) {
  throw_if_any(config.problems());
  return config;
}

}  // namespace

class YoloDetector::Impl {
 public:
  Impl(const DetectorFiles& files, const DetectionConfig& config) : config_(checked(config)) {
    if (config_.backend == Backend::kOpencv && config_.threads > 0) cv::setNumThreads(config_.threads);
    network_ = load_network(files.model, config_);
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
    const Letterbox letterbox = fit_letterbox(size, network_.input);
    fill_canvas(bgr, letterbox);
    const cv::Mat output = network_.network->run(canvas_);
    if (output.total() != static_cast<std::size_t>(network_.candidates) * (4 + class_names_.size())) {
      throw std::runtime_error("the output changed its size");
    }
    const DecodedBoxes decoded = decode_yolo({output.ptr<float>(), network_.classes, network_.candidates},
                                             letterbox, size, config_, network_.centre_sigma);
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
