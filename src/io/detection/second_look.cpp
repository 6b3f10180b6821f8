// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/detection/second_look.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "boxes.hpp"
#include "geoloc/geometry/problems.hpp"
#include "network.hpp"
#include "patch.hpp"
#include "picture.hpp"

namespace geoloc::io {

class SecondLookDetector::Impl {
 public:
  Impl(std::unique_ptr<Detector> first, const std::filesystem::path& network, const DetectionConfig& config)
      : first_(std::move(first)), config_(config) {
    throw_if_any(config_.problems());
    network_ = load_second_look(network, config_);
    const std::vector<int> shape{network_.batch, 3, network_.patch_px, network_.patch_px};
    patches_ = cv::Mat{shape, CV_32F, cv::Scalar::all(0)};
  }

  std::vector<Detection> detect(const cv::Mat& picture) {
    try {
      const cv::Mat bgr = as_bgr(picture);
      const std::vector<Detection> proposed = first_->detect(bgr);  // counts empty pictures too
      return suppress_overlaps(look_again(bgr, proposed), config_);
    } catch (const std::exception&) {  // cv::Exception, ov::Exception, or no memory
      ++failed_images_;
      return {};
    }
  }

  const std::vector<std::string>& class_names() const { return first_->class_names(); }

  DetectorCounts counts() const {
    DetectorCounts counts = first_->counts();
    counts.failed_images += failed_images_;
    counts.rejected_boxes += rejected_boxes_;
    return counts;
  }

 private:
  std::vector<Detection> look_again(const cv::Mat& bgr, const std::vector<Detection>& proposed) {
    std::vector<Detection> seen;
    const auto at_once = static_cast<std::size_t>(network_.batch);
    for (std::size_t begin = 0; begin < proposed.size(); begin += at_once)
      look_at(bgr, proposed, begin, std::min(begin + at_once, proposed.size()), seen);
    return seen;
  }

  /// At as many as the network takes at once, or fewer: then the other patches are of an earlier time, and
  /// their answers are not read.
  void look_at(const cv::Mat& bgr, const std::vector<Detection>& proposed, std::size_t begin, std::size_t end,
               std::vector<Detection>& seen) {
    std::vector<cv::Rect> squares;
    for (std::size_t i = begin; i < end; ++i) {
      squares.push_back(patch_around(proposed[i].box, bgr.size()));
      write_normalised(cut_patch(bgr, squares.back(), network_.patch_px),
                       patches_.ptr<float>(static_cast<int>(i - begin)));
    }
    const cv::Mat answers = network_.network->run(patches_);
    if (answers.total() != static_cast<std::size_t>(network_.batch) * SecondLookAnswer::kValues)
      throw std::runtime_error("the output changed its size");
    for (std::size_t i = begin; i < end; ++i) {
      const SecondLookAnswer answer{answers.ptr<float>() + (i - begin) * SecondLookAnswer::kValues};
      if (const auto detection = detection_of(answer, squares[i - begin], proposed[i].class_id, bgr.size()))
        seen.push_back(*detection);
    }
  }

  /// nullopt where it is not sure enough, or nothing that can be.
  std::optional<Detection> detection_of(const SecondLookAnswer& answer, const cv::Rect& square, int class_id,
                                        cv::Size size) {
    if (!answer.is_sound()) {
      ++rejected_boxes_;
      return std::nullopt;
    }
    if (answer.score < config_.confidence) return std::nullopt;
    const ImageSize picture{size.width, size.height};
    const Box whole = answer.box_in(square);
    const auto box = clipped(whole, picture);
    if (!box) return std::nullopt;
    return Detection{*box, answer.score, class_id,
                     stated_sigma_px(answer.sigma * square.width, whole, picture)};
  }

  const std::unique_ptr<Detector> first_;
  const DetectionConfig config_;
  SecondLookNetwork network_;
  cv::Mat patches_;
  std::uint64_t failed_images_ = 0;
  std::uint64_t rejected_boxes_ = 0;
};

SecondLookDetector::SecondLookDetector(std::unique_ptr<Detector> first, const std::filesystem::path& network,
                                       const DetectionConfig& config)
    : impl_(std::make_unique<Impl>(std::move(first), network, config)) {}

SecondLookDetector::~SecondLookDetector() = default;

std::vector<Detection> SecondLookDetector::detect(const cv::Mat& bgr) {
  return impl_->detect(bgr);
}

const std::vector<std::string>& SecondLookDetector::class_names() const {
  return impl_->class_names();
}

DetectorCounts SecondLookDetector::counts() const {
  return impl_->counts();
}

DetectionConfig proposing(DetectionConfig config) {
  config.confidence = config.second_look.confidence;
  config.max_detections = config.second_look.max_boxes;
  return config;
}

}  // namespace geoloc::io
