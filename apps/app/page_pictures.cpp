// SPDX-License-Identifier: Apache-2.0
#include "app/page_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace geoloc::apps {
namespace {

constexpr int kJpegQuality = 75;

}  // namespace

PagePictures::PagePictures(std::shared_ptr<io::LivePage> page, int width_px)
    : page_(std::move(page)), width_px_(width_px), thread_([this] { run(); }) {}

PagePictures::~PagePictures() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    has_job_.notify_one();
  }
  thread_.join();
}

void PagePictures::offer(const io::VideoFrame& frame, const std::vector<Detection>& detections) {
  if (!page_->wants_picture()) return;
  const std::lock_guard lock(mutex_);
  job_ = Job{frame.bgr, frame.captured_at, detections};
  has_job_.notify_one();
}

void PagePictures::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    has_job_.wait(lock, [this] { return job_ || stop_; });
    if (stop_) return;
    const Job job = std::move(*std::exchange(job_, std::nullopt));
    lock.unlock();
    page_->show(encode(job));
    lock.lock();
  }
}

io::LivePicture PagePictures::encode(const Job& job) const {
  cv::Mat small = job.bgr;
  const double scale = static_cast<double>(width_px_) / job.bgr.cols;
  if (scale < 1.0) {
    const int height_px = std::max(1, static_cast<int>(std::lround(scale * job.bgr.rows)));
    cv::resize(job.bgr, small, {width_px_, height_px}, 0.0, 0.0, cv::INTER_AREA);
  }
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", small, bytes, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality});
  return {{bytes.begin(), bytes.end()}, job.bgr.cols, job.bgr.rows, job.captured_at, job.detections};
}

}  // namespace geoloc::apps
