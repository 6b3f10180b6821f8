// SPDX-License-Identifier: Apache-2.0
#include "common/last_words.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
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

/// With less left, the C library may be unable to begin another heap.
constexpr rlim_t kLittle = rlim_t{64} << 20;

/// Addresses that the process takes [bytes]; 0: it cannot be told. Without memory.
rlim_t addresses_in_use() {
  const int file = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  std::array<char, 32> text{};
  const ssize_t size = ::read(file, text.data(), text.size() - 1);
  ::close(file);
  const rlim_t pages = size > 0 ? std::strtoul(text.data(), nullptr, 10) : 0;
  return pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
}

bool is_memory_used_up() {
  rlimit addresses{};
  return ::getrlimit(RLIMIT_AS, &addresses) == 0 && addresses.rlim_cur != RLIM_INFINITY &&
         addresses_in_use() + kLittle > addresses.rlim_cur;
}

struct sigaction before_us = {};

/// Without memory a stack cannot grow, and libraries use what they were not given. All else is a defect,
/// which ends as it would without us.
void end_by_fault(int signal) {
  if (is_memory_used_up())
    end_with_last_words("not enough memory: its limit is reached (ulimit -v), and a library could not go on");
  ::sigaction(signal, &before_us, nullptr);
  ::raise(signal);
}

/// On a stack of its own, for where the main thread's cannot grow.
void catch_faults() {
  static std::array<char, std::size_t{1} << 16> stack;
  stack_t alternate{};
  alternate.ss_sp = stack.data();
  alternate.ss_size = stack.size();
  ::sigaltstack(&alternate, nullptr);
  struct sigaction action = {};
  action.sa_handler = &end_by_fault;
  action.sa_flags = SA_ONSTACK;
  ::sigaction(SIGSEGV, &action, &before_us);
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
  catch_faults();
}

const char* reason_of(const std::exception& error) {
  const bool is_memory = dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
  return is_memory ? "not enough memory" : error.what();
}

}  // namespace geoloc::apps
