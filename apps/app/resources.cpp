// SPDX-License-Identifier: Apache-2.0
#include "app/resources.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <algorithm>
#include <stdexcept>
#include <string>

namespace geoloc::apps {
namespace {

constexpr rlim_t kLeastFiles = 128;  // a run has 25 open, the page's visitors one each
constexpr rlim_t kEnoughFiles = 4096;
constexpr rlim_t kLeastAddresses_MiB = 1536;  // most of them are never touched

rlimit limit_of(__rlimit_resource resource) {
  rlimit limit{};
  if (::getrlimit(resource, &limit) != 0) return {RLIM_INFINITY, RLIM_INFINITY};
  return limit;
}

/// What may be open after this.
rlim_t raise_open_files() {
  rlimit limit = limit_of(RLIMIT_NOFILE);
  if (limit.rlim_cur >= kEnoughFiles) return limit.rlim_cur;
  limit.rlim_cur = std::min(limit.rlim_max, kEnoughFiles);
  ::setrlimit(RLIMIT_NOFILE, &limit);
  return limit_of(RLIMIT_NOFILE).rlim_cur;
}

}  // namespace

void keep_memory_compact() {
#ifdef __GLIBC__
  mallopt(M_ARENA_MAX, 2);
  mallopt(M_MMAP_THRESHOLD, 256 * 1024);
#endif
}

void give_back_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

void require_resources() {
  const rlim_t files = raise_open_files();
  if (files < kLeastFiles)
    throw std::runtime_error(
        fmt::format("{} files may be open at once, and a run needs {}: raise the limit (ulimit -n {}, or "
                    "LimitNOFILE= of a systemd unit)",
                    files, kLeastFiles, kEnoughFiles));
  const rlim_t addresses_MiB = limit_of(RLIMIT_AS).rlim_cur >> 20;
  if (addresses_MiB < kLeastAddresses_MiB)
    throw std::runtime_error(fmt::format(
        "not enough memory: the program may use {} MiB of addresses, and a run needs {}: raise the "
        "limit (ulimit -v unlimited, or LimitAS= of a systemd unit)",
        addresses_MiB, kLeastAddresses_MiB));
}

}  // namespace geoloc::apps
