// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geoloc/io/output/raw_fixes.hpp"
#include "geoloc/io/output/run_record.hpp"
#include "geoloc/pipeline/geolocator.hpp"

namespace geoloc::apps {

/// What files of a run need of its past. Bounded: past its capacity every second entry is
/// forgotten, so that flights of hours stay drawable.
class RunHistory {
 public:
  explicit RunHistory(std::size_t capacity = 200'000) : capacity_(capacity) {}

  /// Notes the frame that the Geolocator located last.
  /// `frame`: its number. `looks`: one for each of its located detections.
  void note(const Geolocator& geolocator, HostTime captured_at, std::uint64_t frame,
            const std::vector<io::Look>& looks);

  const std::vector<io::RawFix>& raw_fixes() const { return raw_fixes_; }
  const std::vector<io::TrajectoryPoint>& trajectory() const { return trajectory_; }

 private:
  std::size_t capacity_;
  std::vector<io::RawFix> raw_fixes_;
  std::vector<io::TrajectoryPoint> trajectory_;
};

}  // namespace geoloc::apps
