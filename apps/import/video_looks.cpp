// SPDX-License-Identifier: Apache-2.0
#include "import/video_looks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <stdexcept>
#include <utility>

#include "common/progress_line.hpp"
#include "geoloc/io/host_clock.hpp"

namespace geoloc::apps {
namespace {

/// The video from its time 0, frame by frame. Times of a file count from 1970 that way.
std::unique_ptr<io::FileSource> open(const std::filesystem::path& file, const io::HostClock& clock) {
  return std::make_unique<io::FileSource>(file, io::Playback{io::Pace::kAsTaken, HostTime{}},
                                          io::VideoConfig{}, clock);
}

std::optional<io::VideoFrame> next_frame(io::FileSource& source) {
  constexpr auto kWait = std::chrono::milliseconds{100};
  while (true) {
    if (auto frame = source.next(kWait)) return frame;
    if (source.status().state == io::VideoState::kEnded) return std::nullopt;
  }
}

/// The number that a picture's name is, or ends in before its extension.
std::optional<std::uint64_t> frame_number(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  const std::string stem = name.substr(0, dot == 0 ? std::string::npos : dot);
  const std::size_t before = stem.find_last_not_of("0123456789");
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  std::uint64_t number = 0;
  const auto parsed = std::from_chars(stem.data() + begin, stem.data() + stem.size(), number);
  if (parsed.ec != std::errc{}) return std::nullopt;
  return number;
}

std::map<std::uint64_t, std::vector<Detection>> by_frame(const io::Labels& labels,
                                                         const std::string& labels_file) {
  std::map<std::uint64_t, std::vector<Detection>> frames;
  for (const auto& [name, detections] : labels.by_picture) {
    const auto number = frame_number(name);
    if (!number)
      throw std::runtime_error(
          labels_file + ": `" + name +
          "` names no frame: of a video, a picture's name is the number of its frame, from 0");
    frames[*number].insert(frames[*number].end(), detections.begin(), detections.end());
  }
  return frames;
}

}  // namespace

void for_each_frame(const std::filesystem::path& file, const char* progress_text, const StopSignal& stop,
                    std::vector<std::string>& notes,
                    const std::function<void(std::uint64_t number, const io::VideoFrame& frame)>& take) {
  const io::HostClock clock;
  const auto source = open(file, clock);
  const auto milliseconds = [](Duration time) {
    return static_cast<std::size_t>(std::max<Duration::rep>(0, time.count() / 1'000'000));
  };
  ProgressLine progress(progress_text, milliseconds(source->facts().duration.value_or(Duration{})));
  std::uint64_t number = 0, damaged = 0;
  for (; !stop.is_requested(); ++number) {
    const auto frame = next_frame(*source);
    if (!frame) break;
    damaged += frame->damaged ? 1 : 0;
    if (!frame->damaged) take(number, *frame);
    progress.show(milliseconds(frame->captured_at.time_since_epoch()));
  }
  progress.finish();
  const io::VideoStatus status = source->status();
  if (!stop.is_requested() && !status.last_error.empty())
    notes.push_back(fmt::format("{}: ended early: {}", file.string(), status.last_error));
  if (damaged + status.refused > 0)
    notes.push_back(
        fmt::format("{}: {} frames are damaged and left out", file.string(), damaged + status.refused));
}

VideoFacts video_facts(const std::filesystem::path& file) {
  const io::HostClock clock;
  const auto source = open(file, clock);
  const auto first = next_frame(*source);
  if (!first) throw std::runtime_error(file.string() + ": holds no frame that can be decoded");
  return {source->facts(), first->bgr.cols, first->bgr.rows};
}

std::vector<VideoLook> detected_looks(const std::filesystem::path& file, io::Detector& detector,
                                      FoundFile& found, const StopSignal& stop,
                                      std::vector<std::string>& notes) {
  std::size_t failed = 0;
  const bool is_resumed = !found.looks().empty();
  const std::uint64_t begin = is_resumed ? found.looks().back().frame + 1 : 0;
  if (is_resumed) notes.push_back(fmt::format("{}: goes on with frame {}", found.name().string(), begin));
  for_each_frame(file, "looking for objects", stop, notes,
                 [&](std::uint64_t number, const io::VideoFrame& frame) {
                   if (number < begin) return;
                   const std::uint64_t failed_before = detector.counts().failed_images;
                   VideoLook look{number, frame.captured_at.time_since_epoch(), detector.detect(frame.bgr)};
                   // A network that failed saw nothing, which must not count as that nothing was there.
                   if (detector.counts().failed_images > failed_before)
                     ++failed;
                   else
                     found.add(std::move(look));
                 });
  if (failed > 0) notes.push_back(fmt::format("the network failed on {} frames, which are left out", failed));
  return found.looks();
}

std::vector<VideoLook> labelled_looks(const std::filesystem::path& file, const io::Labels& labels,
                                      const std::string& labels_file, const StopSignal& stop,
                                      std::vector<std::string>& notes) {
  const auto labelled = by_frame(labels, labels_file);
  std::vector<VideoLook> looks;
  for_each_frame(file, "reading the video", stop, notes,
                 [&](std::uint64_t number, const io::VideoFrame& frame) {
                   const auto label = labelled.find(number);
                   if (label != labelled.end())
                     looks.push_back({number, frame.captured_at.time_since_epoch(), label->second});
                 });
  if (looks.empty() && !stop.is_requested())
    throw std::runtime_error(labels_file + ": none of its frames is in " + file.string());
  if (looks.size() < labelled.size() && !stop.is_requested())
    notes.push_back(fmt::format("{}: has labels of {} frames that are not in the video", labels_file,
                                labelled.size() - looks.size()));
  return looks;
}

}  // namespace geoloc::apps
