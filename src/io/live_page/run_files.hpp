// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <mutex>
#include <optional>
#include <string>

#include "geoloc/io/live_page/live_document.hpp"

namespace geoloc::io {

/// The run so far as files to download. Each is made at most once a second, one at a time, however many ask.
/// Thread-safe.
class RunFiles {
 public:
  struct File {
    const char* type;
    std::string content;
  };

  /// The document must outlive it.
  explicit RunFiles(const LiveDocument& document) : document_(document) {}

  /// "/objects.geojson", "/objects.kml" or "/objects.gpx"; nullopt for any other path.
  std::optional<File> find(const std::string& path);

 private:
  using Clock = std::chrono::steady_clock;
  struct Made {
    std::string content;
    std::uint64_t revision = 0;
    Clock::time_point at{};
  };

  const LiveDocument& document_;
  std::mutex mutex_;  // guards what follows
  std::array<Made, 3> made_;
};

}  // namespace geoloc::io
