// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <thread>
#include <vector>

#include "geoloc/camera/detection.hpp"
#include "geoloc/io/live_page/live_page.hpp"
#include "geoloc/io/video/video_frame.hpp"

namespace geoloc::apps {

/// Makes the live page's pictures of the video, in a thread of its own and only while somebody looks.
class PagePictures {
 public:
  PagePictures(std::shared_ptr<io::LivePage> page, int width_px);
  ~PagePictures();
  PagePictures(const PagePictures&) = delete;
  PagePictures& operator=(const PagePictures&) = delete;

  /// Returns at once. A frame that comes while the last one is worked on replaces any that waits.
  void offer(const io::VideoFrame& frame, const std::vector<Detection>& detections);

 private:
  struct Job {
    cv::Mat bgr;  // shares the frame's memory, which nobody writes to any more
    HostTime captured_at;
    std::vector<Detection> detections;
  };

  void run();
  io::LivePicture encode(const Job& job) const;

  std::shared_ptr<io::LivePage> page_;
  int width_px_;
  std::mutex mutex_;  // guards what follows
  std::condition_variable has_job_;
  std::optional<Job> job_;
  bool stop_ = false;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace geoloc::apps
