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

/// The start that the video's creation time belongs to; of one alone, that.
std::optional<Duration> own_start(const VideoTimes& video, const LogTimes& log,
                                  const std::vector<Duration>& starts) {
  constexpr Duration kMostApart = std::chrono::seconds{5};
  if (starts.size() == 1) return starts.front();
  if (!video.created_at || !log.begins_at) return std::nullopt;
  const Duration created = by_creation(video, log);
  const auto apart = [&](Duration start) { return start < created ? created - start : start - created; };
  const Duration nearest = *std::min_element(starts.begin(), starts.end(),
                                             [&](Duration a, Duration b) { return apart(a) < apart(b); });
  return apart(nearest) <= kMostApart ? std::optional(nearest) : std::nullopt;
}

/// `what` tells the starts, for people.
Duration start_among(const std::vector<Duration>& starts, const char* what, const VideoTimes& video,
                     const LogTimes& log) {
  if (const auto start = own_start(video, log, starts)) return *start;
  throw std::runtime_error(
      fmt::format("the log has {} {} (the first ones {:.1f} and {:.1f} s after its beginning), and which one "
                  "began this is not known: give it with --log-offset-s",
                  starts.size(), what, seconds(starts[0]), seconds(starts[1])));
}

VideoOffset automatic(const VideoTimes& video, const LogTimes& log) {
  if (log.begins_in_video) return {-*log.begins_in_video, kExactSigma_s, "by the subtitles, frame by frame"};
  if (!log.recordings.empty())
    return {start_among(log.recordings, "recordings of videos", video, log), kExactSigma_s,
            "by the camera's own status in the log"};
  if (!log.video_starts.empty())
    return {start_among(log.video_starts, "commands to begin a video", video, log), kCommandSigma_s,
            "by the command to begin a video in the log"};
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

void add_start(std::vector<Duration>& starts, Duration start) {
  constexpr Duration kSame = std::chrono::seconds{3};
  const bool is_repeated =
      !starts.empty() && std::max(start, starts.back()) - std::min(start, starts.back()) < kSame;
  if (!is_repeated) starts.push_back(start);
}

VideoOffset find_offset(const VideoTimes& video, const LogTimes& log, std::optional<Duration> told) {
  const VideoOffset offset =
      told ? VideoOffset{*told, kExactSigma_s, "by --log-offset-s"} : automatic(video, log);
  refuse_without_overlap(video, log, offset);
  return offset;
}

}  // namespace geoloc::apps
