// SPDX-License-Identifier: Apache-2.0

/// Third-party leaks, for the address sanitizer. GLib leaks its old table of quarks whenever it grows, so
/// that it can be read without a lock; x265 leaks a block at its end. GLib's stack frames cannot be
/// distinguished, so leaks of GStreamer objects are not detected here, but by GStreamer itself:
/// GST_TRACERS=leaks GST_DEBUG=GST_TRACER:7 io_video_rtsp_test
extern "C" const char* __lsan_default_suppressions();   // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __lsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier)
  return "leak:libglib-2.0\nleak:libx265\n";
}
