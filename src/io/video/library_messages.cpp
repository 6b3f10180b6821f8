// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/video/library_messages.hpp"

#include <glib.h>

#include <string_view>
#include <utility>

namespace geoloc::io {
namespace {

/// A field of GLib's message; empty where it has none of that name.
std::string field(const GLogField* fields, gsize count, std::string_view name) {
  for (gsize i = 0; i < count; ++i) {
    if (name != fields[i].key) continue;
    const auto* text = static_cast<const char*>(fields[i].value);
    return fields[i].length < 0 ? std::string(text)
                                : std::string(text, static_cast<std::size_t>(fields[i].length));
  }
  return {};
}

GLogWriterOutput hand_on(GLogLevelFlags level, const GLogField* fields, gsize count, gpointer take) {
  const bool is_fatal = (level & (G_LOG_LEVEL_ERROR | G_LOG_FLAG_FATAL)) != 0;
  if (!is_fatal && (level & (G_LOG_LEVEL_CRITICAL | G_LOG_LEVEL_WARNING)) == 0) return G_LOG_WRITER_HANDLED;
  const std::string domain = field(fields, count, "GLIB_DOMAIN");
  (*static_cast<TakeLibraryMessage*>(take))(
      (domain.empty() ? "" : domain + ": ") + field(fields, count, "MESSAGE"), is_fatal);
  return G_LOG_WRITER_HANDLED;
}

}  // namespace

void take_library_messages(TakeLibraryMessage take) {
  static TakeLibraryMessage taker;  // as GLib's own, which is one for the program and can be set but once
  const bool is_set = static_cast<bool>(taker);
  taker = std::move(take);
  if (!is_set) g_log_set_writer_func(&hand_on, &taker, nullptr);
}

}  // namespace geoloc::io
