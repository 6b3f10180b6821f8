// SPDX-License-Identifier: Apache-2.0

/// Leaks that are not ours, for the address sanitizer. GLib leaves its old table of quarks behind each time
/// that grows, so that it can be read without a lock; x265 a block at its end. GLib's frames cannot be told
/// apart, so leaks of GStreamer objects are not seen here, but by GStreamer itself: GST_TRACERS=leaks
/// GST_DEBUG=GST_TRACER:7 io_video_rtsp_test
extern "C" const char* __lsan_default_suppressions();   // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __lsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier)
  return "leak:libglib-2.0\nleak:libx265\n";
}
