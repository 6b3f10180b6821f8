// SPDX-License-Identifier: Apache-2.0
#include "gst_elements.hpp"

#include <stdexcept>
#include <string_view>

#include "gst_handles.hpp"

namespace geoloc::io {

void init_gstreamer() {
  GError* error = nullptr;
  if (gst_init_check(nullptr, nullptr, &error) != FALSE) return;
  const std::string reason = error != nullptr ? error->message : "no reason given";
  g_clear_error(&error);
  throw std::runtime_error("GStreamer does not start: " + reason);
}

bool has_element(const char* name) {
  return GstObjectPtr<GstElementFactory>{gst_element_factory_find(name)} != nullptr;
}

void require_element(const char* name, const char* debian_package) {
  if (has_element(name)) return;
  throw std::runtime_error(std::string{"GStreamer's element "} + name + " is missing: apt-get install " +
                           debian_package);
}

GstElement* add_element(GstElement* pipeline, const char* name) {
  GstElement* element = gst_element_factory_make(name, nullptr);
  if (element == nullptr)
    throw std::runtime_error(std::string{"GStreamer's element "} + name + " is missing");
  gst_bin_add(GST_BIN(pipeline), element);
  return element;
}

std::string error_text(GstMessage* message) {
  GError* error = nullptr;
  gchar* details = nullptr;
  gst_message_parse_error(message, &error, &details);
  std::string text = error != nullptr ? error->message : "unknown error";
  // The message only says "Could not open resource"; the reason is the last line of the details.
  const std::string_view all = details != nullptr ? details : "";
  if (const auto line_end = all.rfind('\n');
      line_end + 1 < all.size() && line_end != std::string_view::npos) {
    text = all.substr(line_end + 1);
  }
  g_free(details);
  g_clear_error(&error);
  return text;
}

}  // namespace geoloc::io
