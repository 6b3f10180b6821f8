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
  /// Notes the frame that the Geolocator located last.
  /// `frame`: its number. `looks`: one for each of its located detections.
  void note(const Geolocator& geolocator, HostTime captured_at, std::uint64_t frame,
            const std::vector<io::Look>& looks);

  /// No file wants the raw fixes: they are counted, and take no memory.
  void only_count_fixes() { keeps_fixes_ = false; }

  /// Nothing of what was noted holds.
  void begin_anew();

  const std::vector<io::RawFix>& raw_fixes() const { return raw_fixes_; }
  const std::vector<io::TrajectoryPoint>& trajectory() const { return trajectory_; }

  /// How many fixes were noted.
  std::uint64_t fixes() const { return fixes_; }

 private:
  bool keeps_fixes_ = true;
  std::uint64_t fixes_ = 0;
  std::vector<io::RawFix> raw_fixes_;
  std::vector<io::TrajectoryPoint> trajectory_;
};

}  // namespace geoloc::apps
