// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/clock_mapping.hpp"

#include <algorithm>

namespace geoloc::io {
namespace {

constexpr Duration kLongestRoundTrip = std::chrono::seconds{1};
/// A round trip this old says nothing new: the window may also reach back over a pause of the link.
constexpr Duration kLongestMemory = std::chrono::seconds{64};
constexpr Duration kRoundTripSilence = std::chrono::seconds{30};
/// What a crowded link may hold every message back; two clocks that differ by more are different clocks.
constexpr Duration kMaxDisagreement = std::chrono::seconds{2};
/// A host clock that runs back by more was set anew; by less, packets changed places.
constexpr Duration kMaxDisorder = std::chrono::seconds{1};

/// Crystals of two computers differ by 100 ppm at most.
constexpr Duration largest_drift(Duration elapsed) {
  return elapsed / 10'000;
}

// Wide enough for any real clock, narrow enough for differences and sums never to overflow.
constexpr Duration kYear = std::chrono::hours{24 * 365};

constexpr bool is_sane(HostTime time) {
  return time.time_since_epoch() >= Duration::zero() && time.time_since_epoch() < 230 * kYear;
}

constexpr bool is_sane(VehicleTime time) {
  return time.time_since_epoch() >= Duration::zero() && time.time_since_epoch() < 20 * kYear;
}

constexpr std::int64_t second_of(HostTime time) {
  return std::chrono::duration_cast<std::chrono::seconds>(time.time_since_epoch()).count();
}

constexpr Duration difference(VehicleTime vehicle, HostTime host) {
  return vehicle.time_since_epoch() - host.time_since_epoch();
}

}  // namespace

void ArrivalOffset::add(VehicleTime stamp, HostTime received_at) {
  if (received_at < newest_ - kMaxDisorder) clear();
  newest_ = std::max(newest_, received_at);
  const std::int64_t host_s = second_of(received_at);
  const Duration offset = difference(stamp, received_at);
  Second& second = seconds_[static_cast<std::size_t>(host_s) % kWindowSeconds];
  if (second.host_s != host_s) second = {host_s, offset};
  second.largest_offset = std::max(second.largest_offset, offset);

  const std::int64_t oldest_s = second_of(newest_) - static_cast<std::int64_t>(kWindowSeconds) + 1;
  offset_ = offset;
  for (const Second& known : seconds_) {
    if (known.host_s >= oldest_s) offset_ = std::max(*offset_, known.largest_offset);
  }
}

void RoundTripOffset::add(HostTime sent_at, VehicleTime remote, HostTime received_at) {
  if (received_at < newest_ - kMaxDisorder) clear();
  newest_ = std::max(newest_, received_at);
  const HostTime midway = sent_at + (received_at - sent_at) / 2;
  trips_[next_] = {received_at, difference(remote, midway), (received_at - sent_at) / 2};
  next_ = (next_ + 1) % kWindow;
  count_ = std::min(count_ + 1, kWindow);
  estimate();
}

void RoundTripOffset::estimate() {
  std::array<Trip, kWindow> best;
  std::size_t recent = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    const Duration age = newest_ - trips_[i].received_at;
    if (age > kLongestMemory) continue;
    best[recent] = trips_[i];
    best[recent++].error_bound += largest_drift(age);
  }
  if (!offset_ && recent < kEnough) return;  // once known, a thin window is no reason to give it up

  const std::size_t tenth = std::max<std::size_t>(1, recent / 10);
  const auto by_bound = [](const Trip& a, const Trip& b) { return a.error_bound < b.error_bound; };
  std::partial_sort(best.begin(), best.begin() + tenth, best.begin() + recent, by_bound);
  Duration excess{};  // over the first: the offsets themselves are too large to add
  Duration bounds{};
  for (std::size_t i = 0; i < tenth; ++i) {
    excess += best[i].offset - best[0].offset;
    bounds += best[i].error_bound;
  }
  const auto count = static_cast<Duration::rep>(tenth);
  offset_ = best[0].offset + excess / count;
  error_bound_ = bounds / count;
}

void VehicleClockMap::add_round_trip(HostTime sent_at, VehicleTime remote, HostTime received_at) {
  const bool is_believable = is_sane(sent_at) && is_sane(remote) && is_sane(received_at) &&
                             sent_at <= received_at && received_at - sent_at <= kLongestRoundTrip &&
                             agrees_with_arrivals(difference(remote, received_at));
  if (!is_believable) {
    ++counts_.refused_round_trips;
    return;
  }
  ++counts_.round_trips;
  round_trips_.add(sent_at, remote, received_at);
  choose_source(received_at);
}

void VehicleClockMap::add_arrival(VehicleTime stamp, HostTime received_at) {
  if (!is_sane(stamp) || !is_sane(received_at)) {
    ++counts_.refused_arrivals;
    return;
  }
  ++counts_.arrivals;
  arrivals_.add(stamp, received_at);
  // The map serves the stamps. Round trips that contradict them are of another clock, or of one that stepped.
  if (round_trips_.offset() && !agrees_with_arrivals(*round_trips_.offset())) round_trips_.clear();
  choose_source(received_at);
}

bool VehicleClockMap::agrees_with_arrivals(Duration offset) const {
  const auto arrival_offset = arrivals_.offset();
  return !arrival_offset || std::chrono::abs(offset - *arrival_offset) <= kMaxDisagreement;
}

void VehicleClockMap::choose_source(HostTime now) {
  if (arrivals_.offset() && now - round_trips_.newest() > kRoundTripSilence) round_trips_.clear();
  if (round_trips_.offset()) {
    source_ = Source::kRoundTrip;
    offset_ = *round_trips_.offset();
  } else if (arrivals_.offset()) {
    source_ = Source::kArrival;
    offset_ = *arrivals_.offset();
  }
}

std::optional<VehicleTime> VehicleClockMap::to_vehicle(HostTime time) const {
  if (source_ == Source::kNone || !is_sane(time)) return std::nullopt;
  return VehicleTime{time.time_since_epoch() + offset_};
}

std::optional<HostTime> VehicleClockMap::to_host(VehicleTime time) const {
  if (source_ == Source::kNone || !is_sane(time)) return std::nullopt;
  return HostTime{time.time_since_epoch() - offset_};
}

std::optional<Duration> VehicleClockMap::error_bound() const {
  if (source_ != Source::kRoundTrip) return std::nullopt;
  return round_trips_.error_bound();
}

void VehicleClockMap::restart() {
  const Counts counts = counts_;
  *this = VehicleClockMap{};
  counts_ = counts;
}

}  // namespace geoloc::io
