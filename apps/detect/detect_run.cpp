// SPDX-License-Identifier: Apache-2.0
#include "detect/detect_run.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "common/detector_options.hpp"
#include "geoloc/io/host_clock.hpp"
#include "geoloc/io/picture/picture_file.hpp"
#include "geoloc/io/video/file_source.hpp"

namespace geoloc::apps {

using Clock = std::chrono::steady_clock;

DetectRun::DetectRun(io::Detector& detector, ResultWriter& results, const io::VideoConfig& video,
                     std::size_t inputs, double confidence)
    : detector_(detector),
      results_(results),
      video_(video),
      inputs_(inputs),
      confidence_(confidence),
      is_terminal_(::isatty(STDERR_FILENO) == 1) {}

void DetectRun::look_at(const DetectInput& input) {
  ++files_;
  SeenPicture picture{input.file, {}, 0.0, {}};
  try {
    if (!input.is_video) picture.bgr = io::read_picture(input.file);
  } catch (const std::exception& error) {
    tell_unreadable(error.what());
    return;
  }
  if (input.is_video) {
    look_at_video(input);
  } else {
    detect(std::move(picture));
  }
}

void DetectRun::look_at_video(const DetectInput& input) {
  const io::HostClock clock;
  std::unique_ptr<io::FileSource> source;
  try {
    source = std::make_unique<io::FileSource>(input.file, io::Playback{io::Pace::kAsTaken, HostTime{}},
                                              video_, clock);
  } catch (const std::exception& error) {
    tell_unreadable(error.what());
    return;
  }
  for (std::uint64_t frame = 0; !is_stopped();) {
    auto taken = source->next(std::chrono::milliseconds{100});
    if (taken) {
      detect({input.file, frame++, seconds(taken->captured_at.time_since_epoch()), std::move(taken->bgr)});
    } else if (source->status().state == io::VideoState::kEnded) {
      break;
    }
  }
  results_.finish_video();
  const io::VideoStatus status = source->status();
  if (!is_stopped() && !status.last_error.empty())
    tell_unreadable(input.file.string() + ": ended early: " + status.last_error);
  if (status.refused > 0)
    tell_unreadable(fmt::format("{}: {} frames are no usable pictures (empty, or over video.max_megapixels)",
                                input.file.string(), status.refused));
}

void DetectRun::detect(SeenPicture picture) {
  const auto begun = Clock::now();
  const std::vector<Detection> detections = detector_.detect(picture.bgr);
  counts_.detecting_s += std::chrono::duration<double>(Clock::now() - begun).count();
  ++counts_.pictures;
  counts_.with_detections += detections.empty() ? 0U : 1U;
  counts_.detections += detections.size();
  results_.add(picture, detections);
  show_progress(picture);
}

void DetectRun::tell_unreadable(const std::string& reason) {
  finish();
  std::fprintf(stderr, "geoloc_detect: %s\n", reason.c_str());
  ++counts_.unreadable;
}

void DetectRun::show_progress(const SeenPicture& picture) {
  constexpr auto kPeriod = std::chrono::milliseconds{200};
  constexpr auto kLogPeriod = std::chrono::seconds{5};
  const auto now = Clock::now();
  const auto since = now - std::max(shown_, started_);
  if (now - started_ < std::chrono::seconds{1} || since < (is_terminal_ ? kPeriod : kLogPeriod)) return;
  shown_ = now;
  const double rate =
      static_cast<double>(counts_.pictures) / std::chrono::duration<double>(now - started_).count();
  const std::string place = picture.frame ? fmt::format(", {:.1f} s of the video", picture.time_s) : "";
  const std::string text = fmt::format("file {} of {}{}: {} pictures, {:.0f} a second, {} detections", files_,
                                       inputs_, place, counts_.pictures, rate, counts_.detections);
  std::fputs((is_terminal_ ? "\r\033[K" + text : text + "\n").c_str(), stderr);
}

void DetectRun::finish() {
  if (std::exchange(shown_, {}) != Clock::time_point{} && is_terminal_) std::fputs("\r\033[K", stderr);
}

std::string DetectRun::summary() const {
  const double mean_ms =
      counts_.pictures > 0 ? 1e3 * counts_.detecting_s / static_cast<double>(counts_.pictures) : 0.0;
  std::string text = fmt::format("{} pictures, {} with detections, {} detections; {:.1f} ms a picture",
                                 counts_.pictures, counts_.with_detections, counts_.detections, mean_ms);
  const io::DetectorCounts detector = detector_.counts();
  if (counts_.detections == 0) text += fmt::format("; {}", nothing_detected(detector, confidence_));
  if (detector.failed_images > 0)
    text += fmt::format("; the network failed on {} pictures", detector.failed_images);
  if (detector.rejected_boxes > 0)
    text += fmt::format("; {} boxes were refused: no numbers, no size, or a score above 1",
                        detector.rejected_boxes);
  if (counts_.unreadable > 0)
    text += fmt::format("; {} files could not be read to their end", counts_.unreadable);
  return text;
}

}  // namespace geoloc::apps
