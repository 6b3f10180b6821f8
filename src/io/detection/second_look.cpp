// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/detection/second_look.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "boxes.hpp"
#include "geoloc/geometry/refuse.hpp"
#include "geoloc/io/detection/yolo_detector.hpp"
#include "network.hpp"
#include "patch.hpp"
#include "picture.hpp"

namespace geoloc::io {

namespace {

DetectionConfig checked(DetectionConfig config) {
  refuse_if_any(config.problems());
  if (config.confidence <= 0.0) config.confidence = kConfidenceOfOurModels;
  return config;
}

}  // namespace

class SecondLookDetector::Impl {
 public:
  Impl(std::unique_ptr<Detector> first, const std::filesystem::path& network, const DetectionConfig& config)
      : first_(std::move(first)), config_(checked(config)) {
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
    counts.best_score_below = std::max(counts.best_score_below, best_score_below_);
    return counts;
  }

 private:
  std::vector<Detection> look_again(const cv::Mat& bgr, const std::vector<Detection>& proposed) {
    std::vector<cv::Rect> squares;
    std::vector<cv::Mat> patches;
    for (const Detection& proposal : proposed) {
      squares.push_back(patch_around(proposal.box, bgr.size()));
      patches.push_back(cut_patch(bgr, squares.back(), network_.patch_px));
    }
    const std::vector<SecondLookAnswer> answers = judge(patches);
    std::vector<Detection> seen;
    for (std::size_t i = 0; i < proposed.size(); ++i) {
      if (const auto detection = detection_of(answers[i], squares[i], proposed[i].class_id, bgr.size()))
        seen.push_back(*detection);
    }
    return seen;
  }

  /// Evaluates doubtful patches twice more, mirrored, so that errors that change with mirroring average out.
  std::vector<SecondLookAnswer> judge(const std::vector<cv::Mat>& patches) {
    std::vector<SecondLookAnswer> answers = look_at(patches);
    std::vector<cv::Mat> doubtful;
    for (std::size_t i = 0; i < patches.size(); ++i) {
      if (!answers[i].is_in_doubt()) continue;
      for (cv::Mat& image : mirrored(patches[i])) doubtful.push_back(std::move(image));
    }
    const std::vector<SecondLookAnswer> others = look_at(doubtful);
    auto other = others.begin();
    for (SecondLookAnswer& answer : answers) {
      if (!answer.is_in_doubt()) continue;
      answer = agreed(answer, other[0], other[1]);
      other += 2;
    }
    return answers;
  }

  /// Runs as many patches at once as the network takes. In an incomplete batch the other patches are left
  /// from earlier, and the answers to them are not read.
  std::vector<SecondLookAnswer> look_at(const std::vector<cv::Mat>& patches) {
    std::vector<SecondLookAnswer> answers;
    const auto at_once = static_cast<std::size_t>(network_.batch);
    for (std::size_t begin = 0; begin < patches.size(); begin += at_once) {
      const std::size_t count = std::min(at_once, patches.size() - begin);
      for (std::size_t i = 0; i < count; ++i)
        write_normalised(patches[begin + i], patches_.ptr<float>(static_cast<int>(i)));
      const cv::Mat output = network_.network->run(patches_);
      if (output.total() != at_once * SecondLookAnswer::kValues)
        throw std::runtime_error("the output changed its size");
      for (std::size_t i = 0; i < count; ++i)
        answers.emplace_back(output.ptr<float>() + i * SecondLookAnswer::kValues);
    }
    return answers;
  }

  /// nullopt if the answer is not confident enough, or is impossible.
  std::optional<Detection> detection_of(const SecondLookAnswer& answer, const cv::Rect& square, int class_id,
                                        cv::Size size) {
    if (!answer.is_sound()) {
      ++rejected_boxes_;
      return std::nullopt;
    }
    if (answer.score < config_.confidence) {
      best_score_below_ = std::max(best_score_below_, answer.score);
      return std::nullopt;
    }
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
  double best_score_below_ = 0.0;
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
