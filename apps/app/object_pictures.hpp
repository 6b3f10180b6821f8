// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "geoloc/camera/detection.hpp"
#include "geoloc/io/video/video_frame.hpp"
#include "geoloc/pipeline/geolocator.hpp"
#include "geoloc/tracking/track.hpp"

namespace geoloc::apps {

/// Cuts each object's best picture from the video. Pieces of a frame are kept, bounded, until the estimator
/// has said which object each detection is of; the best one of an object is encoded in a thread of its own.
class ObjectPictures {
 public:
  /// Called in the thread with each picture that is better than the one before.
  using OnBetter = std::function<void(std::uint64_t object_id, const std::string& jpeg)>;
  /// Called in the thread, after the last picture of an object that there is no more.
  using OnGone = std::function<void(std::uint64_t object_id)>;

  ObjectPictures(OnBetter on_better, OnGone on_gone);
  ~ObjectPictures();
  ObjectPictures(const ObjectPictures&) = delete;
  ObjectPictures& operator=(const ObjectPictures&) = delete;

  /// A frame that was searched; copies the pieces and returns. Called in the detector's thread.
  void offer(const io::VideoFrame& frame, const std::vector<Detection>& detections);

  /// The same frame after it was located. Called in the estimator's thread.
  void assign(const Geolocator& geolocator, HostTime captured_at);

  /// What waits to be assigned, about.
  std::size_t waiting_bytes() const;

 private:
  struct Piece {
    Box box;
    double worth;
    cv::Mat bgr;
  };
  struct Frame {
    HostTime captured_at;
    std::vector<Piece> pieces;
  };
  struct Job {
    std::uint64_t object_id;
    std::optional<cv::Mat> bgr;  ///< nullopt: the object is gone
  };

  static std::size_t size_bytes(const Frame& frame);
  void drop_oldest();
  std::vector<Piece> take(HostTime captured_at);
  void forget_gone(const std::vector<Track>& objects);
  void run();
  void perform(const Job& job) const;

  OnBetter on_better_;
  OnGone on_gone_;
  std::map<std::uint64_t, double> worth_;  // by object, of its best picture; the estimator's thread's
  mutable std::mutex mutex_;               // guards what follows
  std::condition_variable has_job_;
  std::deque<Frame> waiting_;
  std::size_t waiting_bytes_ = 0;
  std::deque<Job> jobs_;  // in their order, so that what is gone stays gone
  bool stop_ = false;
  std::thread thread_;  // last: it uses all of the above
};

/// How good a picture of what is in a box would be: large, sure, and whole.
double picture_worth(const Detection& detection, int width_px, int height_px);

}  // namespace geoloc::apps
