// SPDX-License-Identifier: Apache-2.0
#include "pipeline/kept_frame.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace geoloc {
namespace {

bool is_usable(const Detection& detection) {
  const Box& box = detection.box;
  return std::isfinite(box.x) && std::isfinite(box.y) && box.width > 0.0 && std::isfinite(box.width) &&
         box.height > 0.0 && std::isfinite(box.height) && std::isfinite(detection.confidence) &&
         (detection.sigma_px == 0.0 || is_sigma_px(detection.sigma_px));
}

bool may_be_cut(const Box& box, const CameraIntrinsics& image, double margin_px) {
  return box.x < margin_px || box.y < margin_px || box.x + box.width > image.width_px - margin_px ||
         box.y + box.height > image.height_px - margin_px;
}

/// Total order on what a detection is: whatever order a detector lists them in, they are treated alike.
bool canonical_order(const Detection& a, const Detection& b) {
  const auto key = [](const Detection& d) {
    return std::make_tuple(-d.confidence, d.box.x, d.box.y, d.box.width, d.box.height, d.class_id,
                           d.sigma_px);
  };
  return key(a) < key(b);
}

/// What cannot be a sigma is as good as none.
double usable_sigma(double time_sigma_s) {
  return time_sigma_s > 0.0 && time_sigma_s <= kLargestTimeSigma_s ? time_sigma_s : 0.0;
}

FrameStamp stamp_of(const FrameDetections& frame) {
  FrameStamp stamp;
  stamp.captured_at = frame.captured_at;
  stamp.captured_at_host = frame.captured_at_host != HostTime{}
                               ? frame.captured_at_host
                               : HostTime{frame.captured_at.time_since_epoch()};
  stamp.time_sigma_s = usable_sigma(frame.time_sigma_s);
  stamp.mount = frame.mount;
  stamp.focal_px = frame.focal_px;
  return stamp;
}

}  // namespace

void KeptFrame::take(const FrameDetections& frame, const GeolocatorConfig& config) {
  stamp = stamp_of(frame);
  detections.clear();
  dropped = at_edge = 0;
  const auto most = static_cast<std::size_t>(config.max_detections);
  for (const Detection& detection : frame.detections) {
    if (!is_usable(detection)) {
      ++dropped;
    } else if (config.edge_margin_px > 0.0 &&
               may_be_cut(detection.box, config.camera.intrinsics, config.edge_margin_px)) {
      ++at_edge;
    } else if (detections.size() < most) {
      detections.push_back(detection);
    } else {
      ++dropped;
      const auto last = std::max_element(detections.begin(), detections.end(), canonical_order);
      if (canonical_order(detection, *last)) *last = detection;
    }
  }
  std::sort(detections.begin(), detections.end(), canonical_order);
}

}  // namespace geoloc
