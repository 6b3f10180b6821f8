// SPDX-License-Identifier: Apache-2.0
#include "common/last_words.hpp"

#include <poll.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <new>

#include "common/command_line.hpp"

namespace geoloc::apps {
namespace {

// A terminate handler and a signal handler can reach nothing else.
const char* program_name = "";

void end_by_exception() {
  try {
    if (const auto thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::exception& error) {
    end_with_last_words(reason_of(error));
  } catch (...) {
    end_with_last_words("an unknown exception");
  }
  end_with_last_words("ended for an unknown reason");
}

void end_by_library(int /*signal*/) {
  end_with_last_words(
      "a library could not go on, for the reason above; are memory, threads or open files limited (ulimit "
      "-a)?");
}

}  // namespace

/// Without memory, locks or much patience: the terminal may be stopped, and memory gone.
void end_with_last_words(const char* reason) {
  for (const char* text : {program_name, ": ", reason, "\n"}) {
    constexpr int kPatience_ms = 500;
    pollfd waiting{STDERR_FILENO, POLLOUT, 0};
    if (::poll(&waiting, 1, kPatience_ms) != 1 || (waiting.revents & POLLOUT) == 0) break;
    if (::write(STDERR_FILENO, text, std::strlen(text)) < 0) break;
  }
  ::_exit(kFailed);
}

void leave_last_words(const char* program) {
  program_name = program;
  std::set_terminate(&end_by_exception);
  std::signal(SIGTRAP, &end_by_library);
}

const char* reason_of(const std::exception& error) {
  const bool is_memory = dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
  return is_memory ? "not enough memory" : error.what();
}

}  // namespace geoloc::apps
