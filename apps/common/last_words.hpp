// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>

namespace geoloc::apps {

/// From now on, what would abort the program ends it with a reason on stderr and exit status kFailed: an
/// exception that nobody catches, in any thread, and a library's own abort for want of memory, threads or
/// open files (GLib raises SIGTRAP, others use what they were not given). `program` must be a literal.
void leave_last_words(const char* program);

/// Says the reason as far as stderr takes it, and ends the program with exit status kFailed.
[[noreturn]] void end_with_last_words(const char* reason);

/// "not enough memory" rather than the standard's words.
const char* reason_of(const std::exception& error);

}  // namespace geoloc::apps
