// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gst/app/gstappsink.h>

#include <opencv2/core/mat.hpp>
#include <optional>

#include "geoloc/geometry/time.hpp"
#include "io/gst/gst_handles.hpp"

// Functions shared by the sources of live and of recorded video.
namespace geoloc::io {

/// An appsink for BGR pictures that holds one frame; `callbacks` are called with `user` in the streaming
/// thread.
GstElement* add_bgr_sink(GstElement* pipeline, GstAppSinkCallbacks callbacks, void* user);

/// When a file was made, as its container tells, in UTC; nullopt where it tells no date and time of day.
std::optional<HostTime> creation_time_of(const GstTagList* tags);

/// A copy of the picture; nullopt if it is not BGR, empty, larger than max_megapixels, or shorter than its
/// header says.
std::optional<cv::Mat> copy_bgr(GstSample* sample, double max_megapixels);

}  // namespace geoloc::io
