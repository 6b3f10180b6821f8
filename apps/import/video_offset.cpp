// SPDX-License-Identifier: Apache-2.0
#include "import/video_offset.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>

namespace geoloc::apps {
namespace {

/// As joint.prior.sigma_latency_s has it by default: what cameras are late by.
constexpr double kExactSigma_s = 0.3;
/// A camera takes a moment to begin, after it was told to.
constexpr double kCommandSigma_s = 0.5;
/// Whole seconds, of which half a one is added, of a clock that nobody looked at.
constexpr double kCreationSigma_s = 1.0;

bool is_whole_second(HostTime time) {
  return time.time_since_epoch() % std::chrono::seconds{1} == Duration{};
}

Duration by_creation(const VideoTimes& video, const LogTimes& log) {
  const Duration half =
      is_whole_second(*video.created_at) ? Duration{std::chrono::milliseconds{500}} : Duration{};
  return *video.created_at + half - *log.begins_at;
}

/// The command that the video's creation time belongs to; of one command alone, that.
std::optional<Duration> own_start(const VideoTimes& video, const LogTimes& log) {
  constexpr Duration kMostApart = std::chrono::seconds{5};
  if (log.video_starts.size() == 1) return log.video_starts.front();
  if (!video.created_at || !log.begins_at) return std::nullopt;
  const Duration created = by_creation(video, log);
  const auto apart = [&](Duration start) { return start < created ? created - start : start - created; };
  const Duration nearest = *std::min_element(log.video_starts.begin(), log.video_starts.end(),
                                             [&](Duration a, Duration b) { return apart(a) < apart(b); });
  return apart(nearest) <= kMostApart ? std::optional(nearest) : std::nullopt;
}

VideoOffset by_commands(const VideoTimes& video, const LogTimes& log) {
  if (const auto start = own_start(video, log))
    return {*start, kCommandSigma_s, "by the command to begin a video in the log"};
  throw std::runtime_error(
      fmt::format("the log has {} commands to begin a video (the first ones {:.1f} and {:.1f} s after its "
                  "beginning), and which one began this is not known: give it with --log-offset-s",
                  log.video_starts.size(), seconds(log.video_starts[0]), seconds(log.video_starts[1])));
}

VideoOffset automatic(const VideoTimes& video, const LogTimes& log) {
  if (log.begins_in_video) return {-*log.begins_in_video, kExactSigma_s, "by the subtitles, frame by frame"};
  if (!log.video_starts.empty()) return by_commands(video, log);
  if (log.exposures.size() == 1)
    return {log.exposures.front(), kCommandSigma_s, "by the only camera message in the log"};
  if (video.created_at && log.begins_at)
    return {by_creation(video, log), kCreationSigma_s, "by the video's creation time"};
  throw std::runtime_error(fmt::format(
      "when the video began is not known ({}, and the log has no camera message that tells): give "
      "--log-offset-s, the seconds from the log's beginning to the video's",
      video.created_at ? "the log tells no UTC" : "the video tells no creation time"));
}

void refuse_without_overlap(const VideoTimes& video, const LogTimes& log, const VideoOffset& offset) {
  const double begin_s = seconds(offset.after_log_begin);
  const double end_s = begin_s + (video.length ? seconds(*video.length) : 0.0);
  if (end_s + 2.0 * offset.sigma_s >= 0.0 && begin_s - 2.0 * offset.sigma_s <= seconds(log.length)) return;
  throw std::runtime_error(
      fmt::format("video and log do not overlap: {}, the video is from {:.1f} to {:.1f} s after the log's "
                  "beginning, and the log is {:.1f} s long. Give --log-offset-s, the seconds from the log's "
                  "beginning to the "
                  "video's, or the log of this flight",
                  offset.how, begin_s, end_s, seconds(log.length)));
}

}  // namespace

VideoOffset find_offset(const VideoTimes& video, const LogTimes& log, std::optional<Duration> told) {
  const VideoOffset offset =
      told ? VideoOffset{*told, kExactSigma_s, "by --log-offset-s"} : automatic(video, log);
  refuse_without_overlap(video, log, offset);
  return offset;
}

}  // namespace geoloc::apps
