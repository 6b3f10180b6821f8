// SPDX-License-Identifier: Apache-2.0
#include "eval/parallel.hpp"

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace geoloc::apps {

void parallel_for(std::size_t count, unsigned threads, const std::function<void(std::size_t)>& step) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        step(i);
      } catch (...) {
        const std::lock_guard lock(failure_mutex);
        if (!failure) failure = std::current_exception();
        next = count;
      }
    }
  };
  std::vector<std::thread> crew;
  for (unsigned i = 1; i < threads; ++i) crew.emplace_back(work);
  work();
  for (std::thread& member : crew) member.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace geoloc::apps
