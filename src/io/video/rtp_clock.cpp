// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/video/rtp_clock.hpp"

#include <algorithm>
#include <cstdlib>

namespace geoloc::io {
namespace {

constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
constexpr std::int64_t kSecondsFrom1900To1970 = 2'208'988'800;
constexpr std::uint32_t kFastestClockHz = 100'000'000;

/// Time from the report to the timestamp. RTP timestamps wrap, so the shorter way round is taken.
Duration elapsed_since(const SenderReport& report, std::uint32_t rtp_timestamp) {
  const auto ticks = static_cast<std::int32_t>(rtp_timestamp - report.rtp_timestamp);
  return Duration{ticks * kNanosecondsPerSecond / static_cast<std::int64_t>(report.ticks_per_second)};
}

std::optional<SenderTime> sender_time(const SenderReport& report, std::uint32_t rtp_timestamp) {
  const Duration elapsed = elapsed_since(report, rtp_timestamp);
  if (std::chrono::abs(elapsed) > RtpClock::kReportLifetime) return std::nullopt;
  return report.sent_at + elapsed;
}

/// Reports agree when one predicts the other: a few milliseconds for how senders pair the two clocks, and 200
/// ppm for how far cheap crystals run apart.
bool agree(const SenderReport& earlier, const SenderReport& later) {
  const auto predicted = sender_time(earlier, later.rtp_timestamp);
  if (!predicted || earlier.ticks_per_second != later.ticks_per_second) return false;
  const Duration elapsed = std::chrono::abs(elapsed_since(earlier, later.rtp_timestamp));
  return std::chrono::abs(*predicted - later.sent_at) <= std::chrono::milliseconds{5} + elapsed / 5000;
}

bool is_same(const SenderReport& a, const SenderReport& b) {
  return a.rtp_timestamp == b.rtp_timestamp && a.sent_at == b.sent_at &&
         a.ticks_per_second == b.ticks_per_second;
}

HostTime whole_microseconds(HostTime time) {
  return std::chrono::floor<std::chrono::microseconds>(time);
}

}  // namespace

SenderTime from_ntp(std::uint64_t ntp_time) {
  const auto whole_s = static_cast<std::int64_t>(ntp_time >> 32) - kSecondsFrom1900To1970;
  const auto fraction_ns = static_cast<std::int64_t>(
      ((ntp_time & 0xffff'ffffU) * static_cast<std::uint64_t>(kNanosecondsPerSecond)) >> 32);
  return SenderTime{Duration{whole_s * kNanosecondsPerSecond + fraction_ns}};
}

Duration RtpClock::SlidingMinimum::observe(HostTime at, Duration value) {
  if (current_ == Duration::max()) half_started_at_ = at;
  if (at - half_started_at_ > kHalfWindow) {
    previous_ = current_;
    current_ = Duration::max();
    half_started_at_ = at;
  }
  current_ = std::min(current_, value);
  return std::min(previous_, current_);
}

void RtpClock::observe(const SenderReport& report) {
  if (report.ticks_per_second == 0 || report.ticks_per_second > kFastestClockHz) return;
  if (newest_ && is_same(*newest_, report)) return;  // a repeated report confirms nothing

  const bool continues = trusted_ && agree(*trusted_, report);
  const bool confirms = newest_ && agree(*newest_, report);
  if (!continues && (confirms || !trusted_)) smallest_delay_.clear();
  if (continues || confirms) trusted_ = report;
  newest_ = report;
}

RtpClock::Capture RtpClock::capture_time(std::uint32_t rtp_timestamp, HostTime received_at) {
  const auto& report = trusted_ ? trusted_ : newest_;
  const auto captured_by_sender = report ? sender_time(*report, rtp_timestamp) : std::nullopt;
  if (!captured_by_sender) return {whole_microseconds(received_at - latency_), TimeQuality::kArrival};

  const HostTime captured_if_utc{captured_by_sender->time_since_epoch()};
  const Duration delay = smallest_delay_.observe(received_at, received_at - captured_if_utc);
  if (delay >= -kLargestLead && delay <= kLargestDelay) {
    return {whole_microseconds(std::min(captured_if_utc, received_at)),
            trusted_ ? TimeQuality::kRecovered : TimeQuality::kUnconfirmed};
  }
  return {whole_microseconds(captured_if_utc + delay - latency_), TimeQuality::kForeignClock};
}

}  // namespace geoloc::io
