// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/clock_mapping.hpp"

#include <algorithm>

namespace geoloc::io {
namespace {

constexpr Duration kLongestRoundTrip = std::chrono::seconds{1};
/// A round trip this old says nothing new: the window may also reach back over a pause of the link.
constexpr Duration kLongestMemory = std::chrono::seconds{64};
constexpr Duration kRoundTripSilence = std::chrono::seconds{30};
/// How far a stamp or a round trip may lie beyond what is possible: whole milliseconds, and clocks that drift
/// while round trips of a minute are remembered.
constexpr Duration kTolerance = std::chrono::milliseconds{50};
/// The same where only arrivals are known, whose least delay may become less.
constexpr Duration kArrivalTolerance = std::chrono::milliseconds{200};
/// One stray stamp proves nothing.
constexpr int kFutureStamps = 3;
/// A first contradiction and its confirmation lie no further apart.
constexpr Duration kContradictionMemory = std::chrono::seconds{10};
/// For so long all messages must have been late by the same to show a step where no round trip does,
constexpr Duration kSteadyLateness = std::chrono::seconds{2};
/// so many of them,
constexpr int kSteadyMessages = 20;
/// the least delayed of any moment within so much.
constexpr Duration kSteadyWithin = std::chrono::milliseconds{50};
/// What arrivals remember.
constexpr Duration kArrivalMemory = std::chrono::seconds{15};
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
  if (!offset_ && recent < enough_) return;  // once known, a thin window is no reason to give it up

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
  const bool is_possible = is_sane(sent_at) && is_sane(remote) && is_sane(received_at) &&
                           sent_at <= received_at && received_at - sent_at <= kLongestRoundTrip;
  if (!is_possible) {
    ++counts_.refused_round_trips;
    return;
  }
  const OffsetBounds bounds{difference(remote, received_at), difference(remote, sent_at), sent_at};
  if (!is_of_the_stamps(bounds)) {
    ++counts_.refused_round_trips;
    return;
  }
  if (contradicts_map(bounds)) {
    if (!is_confirmed(bounds)) {
      contradiction_ = bounds;
      ++counts_.refused_round_trips;
      return;
    }
    const HostTime since = contradiction_ ? contradiction_->sent_at : sent_at;
    step(bounds.least + (bounds.most - bounds.least) / 2, bounds.most, since);
  }
  contradiction_.reset();
  ++counts_.round_trips;
  round_trips_.add(sent_at, remote, received_at);
  choose_source(received_at);
}

/// The map serves the stamps: none of them may come from beyond the bounds, nor far below.
bool VehicleClockMap::is_of_the_stamps(const OffsetBounds& bounds) const {
  const auto newest = newest_arrivals_.largest_offset();
  return !newest || (*newest <= bounds.most + kTolerance && *newest >= bounds.least - kMaxDisagreement);
}

bool VehicleClockMap::contradicts_map(const OffsetBounds& bounds) const {
  if (source_ == Source::kNone) return false;
  const Duration tolerance = kTolerance + round_trips_.error_bound();
  if (offset_ > bounds.most + tolerance) return true;
  return source_ == Source::kRoundTrip && offset_ < bounds.least - tolerance;
}

/// By a second round trip, or by messages that are all late.
bool VehicleClockMap::is_confirmed(const OffsetBounds& bounds) const {
  if (contradiction_ && bounds.sent_at - contradiction_->sent_at <= kContradictionMemory &&
      bounds.overlaps(*contradiction_))
    return true;
  return newest_arrivals_.lateness() && offset_ > bounds.most;
}

void VehicleClockMap::add_arrival(VehicleTime stamp, HostTime received_at) {
  if (!is_sane(stamp) || !is_sane(received_at)) {
    ++counts_.refused_arrivals;
    return;
  }
  ++counts_.arrivals;
  newest_ = received_at;
  if (received_at < known_since_ - kMaxDisorder) known_since_ = HostTime{};  // the host's clock was set back
  const Duration offset = difference(stamp, received_at);
  newest_arrivals_.add(offset, received_at);
  if (const auto by = lead(offset)) {
    take_stamp_from_the_future(*by, received_at);
    return;
  }
  stamps_from_the_future_ = 0;
  if (!arrivals_.offset()) arrivals_since_ = received_at;
  arrivals_.add(stamp, received_at);
  newest_arrivals_.compare(*arrivals_.offset(), received_at);
  // The map serves the stamps. Round trips that contradict them are of another clock.
  const bool is_of_another_clock =
      round_trips_.offset() &&
      std::chrono::abs(*round_trips_.offset() - *arrivals_.offset()) > kMaxDisagreement;
  if (is_of_another_clock) round_trips_.clear();
  choose_source(received_at);
  believe_steady_lateness(received_at);
}

/// By how much a message that arrives with that offset comes before its own stamp; nullopt where it does not.
std::optional<Duration> VehicleClockMap::lead(Duration offset) const {
  const Duration by = offset - offset_;
  if (source_ == Source::kRoundTrip && by > kTolerance + round_trips_.error_bound()) return by;
  const bool is_settled =
      source_ == Source::kArrival && std::chrono::abs(newest_ - arrivals_since_) > kSteadyLateness;
  if (is_settled && by > kArrivalTolerance) return by;
  return std::nullopt;
}

bool VehicleClockMap::is_early(VehicleTime stamp, HostTime received_at) const {
  return is_sane(stamp) && is_sane(received_at) && lead(difference(stamp, received_at)).has_value();
}

void VehicleClockMap::take_stamp_from_the_future(Duration lead, HostTime received_at) {
  if (stamps_from_the_future_ == 0) {
    future_since_ = received_at;
    largest_lead_ = lead;
  }
  largest_lead_ = std::max(largest_lead_, lead);
  if (++stamps_from_the_future_ < kFutureStamps) return;
  step(offset_ + largest_lead_, offset_ + largest_lead_, future_since_);
  choose_source(received_at);
}

/// Without round trips. A crowded link does not delay the luckiest message of any moment by the same.
void VehicleClockMap::believe_steady_lateness(HostTime now) {
  const auto& late = newest_arrivals_.lateness();
  if (source_ != Source::kArrival || !late || now - late->since < kSteadyLateness) return;
  if (late->messages < kSteadyMessages || late->most - late->least > kSteadyWithin) return;
  const Duration offset = *newest_arrivals_.largest_offset();
  step(offset, offset, late->since);
  unproven_until_ = now + kArrivalMemory;
  choose_source(now);
}

/// The offset is `offset` now, and `most` at most, since about `since`.
void VehicleClockMap::step(Duration offset, Duration most, HostTime since) {
  ++counts_.steps;
  last_step_ = offset - offset_;
  known_since_ = since;
  if (const auto& late = newest_arrivals_.lateness()) known_since_ = std::min(known_since_, late->since);
  unproven_until_ = HostTime{};
  contradiction_.reset();
  stamps_from_the_future_ = 0;
  round_trips_.restart();
  const NewestArrivals newest = newest_arrivals_;
  arrivals_.clear();
  newest_arrivals_.clear();
  arrivals_since_ = newest_;
  source_ = Source::kNone;
  newest.for_each([&](Duration known, HostTime received_at) {
    if (known > most + kTolerance) return;
    newest_arrivals_.add(known, received_at);
    arrivals_.add(VehicleTime{received_at.time_since_epoch() + known}, received_at);
  });
}

void VehicleClockMap::choose_source(HostTime now) {
  if (arrivals_.offset() && now - round_trips_.newest() > kRoundTripSilence) round_trips_.clear();
  if (round_trips_.offset()) {
    source_ = Source::kRoundTrip;
    offset_ = *round_trips_.offset();
  } else if (arrivals_.offset()) {
    const bool has_forgotten_a_step =
        source_ == Source::kArrival && *arrivals_.offset() < offset_ - kArrivalTolerance;
    if (has_forgotten_a_step) {
      ++counts_.steps;
      last_step_ = *arrivals_.offset() - offset_;
    }
    source_ = Source::kArrival;
    offset_ = *arrivals_.offset();
  }
}

Duration VehicleClockMap::doubt() const {
  Duration doubt{};
  if (stamps_from_the_future_ > 0) doubt = largest_lead_;
  if (const auto& late = newest_arrivals_.lateness()) doubt = std::max(doubt, late->most);
  if (newest_ < unproven_until_) doubt = std::max(doubt, std::chrono::abs(last_step_));
  return doubt;
}

std::optional<VehicleTime> VehicleClockMap::to_vehicle(HostTime time) const {
  if (source_ == Source::kNone || !is_sane(time) || is_before_step(time)) return std::nullopt;
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
