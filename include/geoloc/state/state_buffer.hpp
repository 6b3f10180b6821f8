// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "geoloc/geometry/expected.hpp"
#include "geoloc/geometry/time.hpp"
#include "geoloc/state/interpolation.hpp"
#include "geoloc/state/vehicle_state.hpp"

namespace geoloc {

/// The two samples around a time.
template <typename T>
struct Bracket {
  T before;
  T after;
  Duration spacing;  ///< after's time minus before's; zero where there is but the one, of exactly that time
  double alpha;      ///< paper, eq. 4; outside [0, 1] only within the permitted extrapolation

  /// 1-sigma of what was interpolated, where the quantity is known at the samples and changes its rate by an
  /// unknown `acceleration` [1/s^2] in between; zero at the samples.
  double sigma(double acceleration) const {
    const double spacing_s = seconds(spacing);
    return 0.5 * acceleration * std::abs(alpha * (1.0 - alpha)) * spacing_s * spacing_s;
  }

  T interpolated() const { return Interpolator<T>::between(before, after, alpha); }
};

/// The last N samples of one quantity, ordered by time, filled asynchronously (paper, eq. 1-2). Samples may
/// come out of order; a second sample of the same time and samples older than a full buffer are refused and
/// counted. insert() is O(1) in order, O(N) out of order; bracket() is O(log N). Never allocates.
template <typename T, std::size_t N = 512>
class StateBuffer {
  static_assert(N >= 2, "interpolation needs two samples");

 public:
  struct Counters {
    std::uint64_t inserted = 0;
    std::uint64_t duplicates = 0;
    std::uint64_t stale = 0;
  };

  /// False where the sample was refused.
  bool insert(VehicleTime time, const T& value);

  /// The samples around `time`, if they are at most max_gap apart or one of them is near (kNear); a sample of
  /// exactly that time needs no other. A time beyond the newest sample by at most max_extrapolation is
  /// answered from the last two.
  Expected<Bracket<T>, NoState> bracket(VehicleTime time, Duration max_gap, Duration max_extrapolation) const;

  /// What is to be known so soon before or after a sample is known well enough, far as the next one may be.
  static constexpr Duration kNear = std::chrono::milliseconds{200};

  /// Whether a sample has come from beyond that time.
  bool reaches_beyond(VehicleTime time) const { return size_ > 0 && sample(size_ - 1).time > time; }

  std::optional<T> oldest() const { return size_ > 0 ? std::optional<T>(sample(0).value) : std::nullopt; }

  void clear() { size_ = 0; }
  std::size_t size() const { return size_; }
  const Counters& counters() const { return counters_; }

 private:
  struct Sample {
    VehicleTime time;
    T value;
  };

  Sample& sample(std::size_t i) { return ring_[(oldest_ + i) % N]; }
  const Sample& sample(std::size_t i) const { return ring_[(oldest_ + i) % N]; }
  std::size_t first_not_before(VehicleTime time) const;

  std::array<Sample, N> ring_{};
  std::size_t oldest_ = 0;  // place of the oldest sample in the ring
  std::size_t size_ = 0;
  Counters counters_;
};

template <typename T, std::size_t N>
std::size_t StateBuffer<T, N>::first_not_before(VehicleTime time) const {
  std::size_t low = 0, high = size_;
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (sample(middle).time < time) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low;
}

template <typename T, std::size_t N>
bool StateBuffer<T, N>::insert(VehicleTime time, const T& value) {
  std::size_t place = size_ == 0 || sample(size_ - 1).time < time ? size_ : first_not_before(time);
  if (place < size_ && sample(place).time == time) {
    ++counters_.duplicates;
    return false;
  }
  if (size_ == N) {
    if (place == 0) {
      ++counters_.stale;
      return false;
    }
    oldest_ = (oldest_ + 1) % N;  // drops the oldest
    --size_;
    --place;
  }
  ++size_;
  for (std::size_t i = size_ - 1; i > place; --i) sample(i) = sample(i - 1);
  sample(place) = {time, value};
  ++counters_.inserted;
  return true;
}

template <typename T, std::size_t N>
Expected<Bracket<T>, NoState> StateBuffer<T, N>::bracket(VehicleTime time, Duration max_gap,
                                                         Duration max_extrapolation) const {
  if (size_ == 0) return NoState::kNoSamples;
  const std::size_t place = first_not_before(time);
  if (place < size_ && sample(place).time == time) {
    if (size_ == 1) return Bracket<T>{sample(0).value, sample(0).value, Duration::zero(), 0.0};
    const bool is_newest = place + 1 == size_;
    const bool is_next_far = !is_newest && sample(place + 1).time - time > max_gap;
    const bool is_last_nearer = place > 0 && time - sample(place - 1).time <= max_gap;
    const std::size_t first = is_newest || (is_next_far && is_last_nearer) ? place - 1 : place;
    return Bracket<T>{sample(first).value, sample(first + 1).value,
                      sample(first + 1).time - sample(first).time, first == place ? 0.0 : 1.0};
  }
  if (place == 0) return time < sample(0).time ? NoState::kTooOld : NoState::kNotYet;
  if (place == size_ && (size_ < 2 || time - sample(size_ - 1).time > max_extrapolation))
    return NoState::kNotYet;
  const Sample& after = sample(place < size_ ? place : size_ - 1);
  const Sample& before = sample(place < size_ ? place - 1 : size_ - 2);
  const Duration spacing = after.time - before.time;
  if (spacing > max_gap) {
    if (place == size_) return NoState::kNotYet;
    if (time - before.time > kNear && after.time - time > kNear) return NoState::kInAGap;
  }
  return Bracket<T>{before.value, after.value, spacing, seconds(time - before.time) / seconds(spacing)};
}

}  // namespace geoloc
