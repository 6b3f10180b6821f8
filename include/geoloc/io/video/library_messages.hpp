// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace geoloc::io {

/// Called from any thread. After a fatal message, GLib aborts the program when this returns.
using TakeLibraryMessage = std::function<void(const std::string& message, bool is_fatal)>;

/// From now on, GLib and GStreamer hand on their warnings rather than write them to stderr, where a stopped
/// terminal would stop the thread that they warn in. To be called before either is used.
void take_library_messages(TakeLibraryMessage take);

}  // namespace geoloc::io
