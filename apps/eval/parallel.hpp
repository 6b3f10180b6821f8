// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

namespace geoloc::apps {

/// Runs step(i) for i below `count` on several threads; the first exception is passed on.
void parallel_for(std::size_t count, unsigned threads, const std::function<void(std::size_t)>& step);

}  // namespace geoloc::apps
