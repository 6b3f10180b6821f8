// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/video/library_messages.hpp"

#include <glib.h>
#include <gtest/gtest.h>

#include <vector>

namespace geoloc::io {
namespace {

TEST(LibraryMessages, OfGlibAreHandedOnRatherThanWritten) {
  std::vector<std::string> messages;
  take_library_messages([&messages](const std::string& message, bool is_fatal) {
    EXPECT_FALSE(is_fatal);
    messages.push_back(message);
  });
  ::testing::internal::CaptureStderr();
  g_log("GStreamer", G_LOG_LEVEL_WARNING, "plugin %s is damaged", "x");
  g_log("GLib", G_LOG_LEVEL_CRITICAL, "assertion failed");
  g_log("GLib", G_LOG_LEVEL_DEBUG, "nothing to say");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(messages, (std::vector<std::string>{"GStreamer: plugin x is damaged", "GLib: assertion failed"}));
}

TEST(LibraryMessagesDeathTest, ThatAreFatalAreHandedOnFirst) {
  const auto end_by_message = [] {
    take_library_messages([](const std::string& message, bool is_fatal) {
      if (is_fatal && message == "GLib: cannot go on") std::_Exit(7);
    });
    g_log("GLib", G_LOG_LEVEL_ERROR, "cannot go on");
  };
  EXPECT_EXIT(end_by_message(), ::testing::ExitedWithCode(7), "");
}

}  // namespace
}  // namespace geoloc::io
