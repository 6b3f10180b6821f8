// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gst/gst.h>

#include <memory>

// Owners of GStreamer's reference-counted objects: a result with "transfer full" goes into one of these.
namespace geoloc::io {

template <auto Release>
struct Releaser {
  template <typename T>
  void operator()(T* object) const {
    Release(object);
  }
};

template <typename T>
using GstObjectPtr = std::unique_ptr<T, Releaser<gst_object_unref>>;
using GstCapsPtr = std::unique_ptr<GstCaps, Releaser<gst_caps_unref>>;
using GstMessagePtr = std::unique_ptr<GstMessage, Releaser<gst_message_unref>>;
template <typename T>
using GObjectPtr = std::unique_ptr<T, Releaser<g_object_unref>>;
using GstSamplePtr = std::unique_ptr<GstSample, Releaser<gst_sample_unref>>;
using GstBufferPtr = std::unique_ptr<GstBuffer, Releaser<gst_buffer_unref>>;

/// Stops a pipeline and waits for its threads before it goes.
struct PipelineStopper {
  void operator()(GstElement* pipeline) const {
    gst_element_set_state(pipeline, GST_STATE_NULL);
    gst_object_unref(pipeline);
  }
};
using GstPipelinePtr = std::unique_ptr<GstElement, PipelineStopper>;

}  // namespace geoloc::io
