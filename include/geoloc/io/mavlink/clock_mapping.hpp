// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "geoloc/geometry/time.hpp"
#include "geoloc/io/mavlink/newest_arrivals.hpp"

namespace geoloc::io {

/// Offset of the vehicle's clock (vehicle - host) from one-way traffic: a stamp arrives late, never early, so
/// the largest stamp - arrival of the last 15 s lies below the true offset by the link's smallest delay, and
/// by the drift of the two clocks over those seconds (1.5 ms at 100 ppm).
class ArrivalOffset {
 public:
  void add(VehicleTime stamp, HostTime received_at);
  std::optional<Duration> offset() const { return offset_; }
  void clear() { *this = ArrivalOffset{}; }

 private:
  static constexpr std::size_t kWindowSeconds = 16;  // of which the newest is still filling

  struct Second {
    std::int64_t host_s = -1;  ///< which second of the host clock
    Duration largest_offset{};
  };

  std::array<Second, kWindowSeconds> seconds_{};
  HostTime newest_{};
  std::optional<Duration> offset_;
};

/// Offset of the vehicle's clock (vehicle - host) from round trips. One of them is wrong by half its duration
/// at most, and by what the clocks have drifted since. The tenth of the window whose bounds are lowest is
/// averaged: the clock filter of NTP (RFC 5905, section 10) over more samples.
class RoundTripOffset {
 public:
  void add(HostTime sent_at, VehicleTime remote, HostTime received_at);
  /// No answer before kEnough round trips in a minute; after a step the first one answers.
  std::optional<Duration> offset() const { return offset_; }
  Duration error_bound() const { return error_bound_; }
  HostTime newest() const { return newest_; }
  void clear() { *this = RoundTripOffset{}; }
  /// The vehicle's clock stepped: what was known of it is void.
  void restart() {
    clear();
    enough_ = 1;
  }

 private:
  static constexpr std::size_t kWindow = 64;
  static constexpr std::size_t kEnough = 4;

  struct Trip {
    HostTime received_at;
    Duration offset;
    Duration error_bound;  ///< at the newest trip
  };

  void estimate();

  std::array<Trip, kWindow> trips_{};
  std::size_t count_ = 0;
  std::size_t next_ = 0;
  std::size_t enough_ = kEnough;
  HostTime newest_{};
  Duration error_bound_{};
  std::optional<Duration> offset_;
};

/// What one round trip proves: the vehicle read its clock somewhere between the two ends.
struct OffsetBounds {
  Duration least;
  Duration most;
  HostTime sent_at;

  bool overlaps(const OffsetBounds& other) const { return least <= other.most && other.least <= most; }
};

/// Maps the vehicle's boot clock to the host clock and back. Round trips (MAVLink TIMESYNC) rule once there
/// are enough of them; until then, and after kRoundTripSilence without one, the arrival of stamped messages
/// does. The change between them is a step of the link's one-way delay, and cannot happen often. Integer
/// nanoseconds, no allocation; the same calls give the same map.
///
/// Clocks also step: a vehicle's that stopped for a moment, a host's that was suspended. Delays do not look
/// like it: no message arrives before its stamp, and a round trip encloses the offset however long it took.
/// Where one of the two is violated, twice, the clock has stepped: what was known is forgotten, and times
/// before the step have no vehicle time any more. Late messages alone prove nothing; while all are late, the
/// map is in doubt by as much, and without round trips a lateness that stays the same is held for a step.
class VehicleClockMap {
 public:
  enum class Source { kNone, kArrival, kRoundTrip };

  struct Counts {
    std::uint64_t round_trips = 0;
    std::uint64_t refused_round_trips = 0;
    std::uint64_t arrivals = 0;
    std::uint64_t refused_arrivals = 0;
    std::uint64_t steps = 0;
  };

  /// A request left at `sent_at`, the vehicle read its clock as `remote`, the answer came at `received_at`.
  /// The error is half the trip at most, and half the difference of the two ways in fact. Refused: a trip
  /// that ran backwards or took more than a second; times that no clock shows; a clock that is not the one of
  /// the stamped messages; the first to contradict the map.
  void add_round_trip(HostTime sent_at, VehicleTime remote, HostTime received_at);

  /// A message that the vehicle stamped `stamp` came at `received_at`. Stamps are to be checked for reboots
  /// beforehand (BootClockMonitor).
  void add_arrival(VehicleTime stamp, HostTime received_at);

  /// Whether a message that comes then with that stamp would come before it: the clock has stepped, or the
  /// stamp is false.
  bool is_early(VehicleTime stamp, HostTime received_at) const;

  /// nullopt before the first message, for a time before the last step, and for one beyond any clock.
  std::optional<VehicleTime> to_vehicle(HostTime time) const;
  std::optional<HostTime> to_host(VehicleTime time) const;

  /// Whether that time lies before a step: it will never have a vehicle time.
  bool is_before_step(HostTime time) const { return time < known_since_; }

  Source source() const { return source_; }

  /// Bound of the map's error. nullopt while arrivals rule: the one-way delay in it is unknown.
  std::optional<Duration> error_bound() const;

  /// By how much the map may be wrong because the clock may have stepped just now; zero where nothing says
  /// so.
  Duration doubt() const;

  /// Vehicle - host after the last step, minus the same before it.
  Duration last_step() const { return last_step_; }

  /// Since construction: restart() keeps them.
  const Counts& counts() const { return counts_; }

  /// Forgets the clock (the vehicle rebooted).
  void restart();

 private:
  bool is_of_the_stamps(const OffsetBounds& bounds) const;
  bool contradicts_map(const OffsetBounds& bounds) const;
  bool is_confirmed(const OffsetBounds& bounds) const;
  std::optional<Duration> lead(Duration offset) const;
  void take_stamp_from_the_future(Duration lead, HostTime received_at);
  void believe_steady_lateness(HostTime now);
  void step(Duration offset, Duration most, HostTime since);
  void choose_source(HostTime now);

  ArrivalOffset arrivals_;
  NewestArrivals newest_arrivals_;
  RoundTripOffset round_trips_;
  std::optional<OffsetBounds> contradiction_;  // the last round trip, where it contradicts the map
  int stamps_from_the_future_ = 0;             // in a row
  HostTime future_since_{};
  Duration largest_lead_{};
  Source source_ = Source::kNone;
  Duration offset_{};
  HostTime arrivals_since_{};  // of the present clock
  HostTime known_since_{};
  HostTime unproven_until_{};  // a step that no round trip has shown
  HostTime newest_{};
  Duration last_step_{};
  Counts counts_;
};

}  // namespace geoloc::io
