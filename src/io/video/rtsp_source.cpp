// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/video/rtsp_source.hpp"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <stdexcept>
#include <thread>
#include <utility>

#include "geoloc/geometry/refuse.hpp"
#include "geoloc/io/video/camera_clock.hpp"
#include "geoloc/io/video/frame_exchange.hpp"
#include "geoloc/io/video/stream_url.hpp"
#include "io/gst/gst_elements.hpp"
#include "rtsp_session.hpp"

namespace geoloc::io {
namespace {

/// A server that is there but not to be believed is not asked more often, in the end.
constexpr double kPauseOfFault_s = 10.0;

}  // namespace

class RtspSource::Impl {
 public:
  Impl(std::string url, const VideoConfig& config, const HostClock& clock,
       std::shared_ptr<EncodedVideoTaker> taker)
      : url_(std::move(url)),
        config_(config),
        clock_(clock),
        taker_(std::move(taker)),
        began_at_(clock.now()) {
    if (!is_rtsp_url(url_)) {
      throw std::invalid_argument("not an RTSP address: " + without_credentials(url_) +
                                  " (expected rtsp://[user:password@]host[:port]/path)");
    }
    refuse_if_any(config_.problems());
    init_gstreamer();
    require_rtsp_elements();
    thread_ = std::thread{[this] { run(); }};
  }

  ~Impl() {
    {
      const std::lock_guard lock{mutex_};
      stop_ = true;
    }
    stopped_.notify_all();
    exchange_.end();
    thread_.join();
  }

  std::optional<VideoFrame> next(Duration timeout) { return exchange_.take(timeout); }
  std::vector<FrameTelemetry> take_telemetry() { return exchange_.take_telemetry(); }
  VideoStatus status() const { return exchange_.status(clock_.now()); }

 private:
  void run() {
    double retry_s = config_.retry_min_s;
    while (!stop_) {
      const Outcome outcome = attempt();
      if (outcome.has_delivered) retry_s = config_.retry_min_s;
      std::unique_lock lock{mutex_};
      stopped_.wait_for(lock, from_seconds(retry_s), [this] { return stop_.load(); });
      const double longest_s =
          outcome.is_server_at_fault ? std::max(kPauseOfFault_s, config_.retry_max_s) : config_.retry_max_s;
      retry_s = std::min(2 * retry_s, longest_s);
    }
  }

  struct Outcome {
    bool has_delivered = false;  ///< frames
    bool is_server_at_fault = false;
  };

  /// Runs one connection from beginning to end. It must not throw, because the thread goes on.
  Outcome attempt() {
    exchange_.begin_attempt();
    Outcome outcome;
    std::string why;
    try {
      const RtspSession session{url_,          config_,   clock_,
                                camera_clock_, exchange_, PictureTap(taker_, clock_.now() - began_at_)};
      why = session.wait_until_over(stop_);
      outcome = {session.has_delivered(), session.is_server_at_fault()};
    } catch (const std::exception& error) {
      why = error.what();
    }
    if (stop_) return outcome;
    exchange_.report_error(without_credentials(url_) + ": " + without_credentials_of(url_, why));
    exchange_.set_state(VideoState::kRetrying);
    return outcome;
  }

  const std::string url_;
  const VideoConfig config_;
  const HostClock& clock_;
  const std::shared_ptr<EncodedVideoTaker> taker_;
  const HostTime began_at_;
  CameraClock camera_clock_;  // outlives connections
  FrameExchange exchange_;
  std::mutex mutex_;
  std::condition_variable stopped_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

RtspSource::RtspSource(std::string url, const VideoConfig& config, const HostClock& clock,
                       std::shared_ptr<EncodedVideoTaker> taker)
    : impl_(std::make_unique<Impl>(std::move(url), config, clock, std::move(taker))) {}

RtspSource::~RtspSource() = default;

std::optional<VideoFrame> RtspSource::next(Duration timeout) {
  return impl_->next(timeout);
}

std::vector<FrameTelemetry> RtspSource::take_telemetry() {
  return impl_->take_telemetry();
}

VideoStatus RtspSource::status() const {
  return impl_->status();
}

}  // namespace geoloc::io
