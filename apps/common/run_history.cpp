// SPDX-License-Identifier: Apache-2.0
#include "common/run_history.hpp"

namespace geoloc::apps {
namespace {

constexpr std::size_t kMostFixes = 200'000;
/// Half an hour at ten frames a second, and a megabyte.
constexpr std::size_t kMostPoints = 20'000;

template <typename T>
void append_bounded(std::vector<T>& entries, const T& entry, std::size_t capacity) {
  if (entries.size() >= capacity) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < entries.size(); i += 2) entries[kept++] = entries[i];
    entries.erase(entries.begin() + static_cast<std::ptrdiff_t>(kept), entries.end());
  }
  entries.push_back(entry);
}

}  // namespace

void RunHistory::note(const Geolocator& geolocator, HostTime captured_at, std::uint64_t frame,
                      const std::vector<io::Look>& looks) {
  append_bounded(trajectory_,
                 io::TrajectoryPoint{captured_at, geolocator.view().vehicle.enu_from_body.translation},
                 kMostPoints);
  fixes_ += looks.size();
  if (!keeps_fixes_) return;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const LocatedDetection& located = geolocator.located()[i];
    append_bounded(raw_fixes_,
                   io::RawFix{captured_at, located.detection, located.fix.position_in_enu,
                              located.fix.range_m, frame, looks[i]},
                   kMostFixes);
  }
}

void RunHistory::begin_anew() {
  fixes_ = 0;
  raw_fixes_.clear();
  trajectory_.clear();
}

}  // namespace geoloc::apps
