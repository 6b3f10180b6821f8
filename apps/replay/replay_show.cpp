// SPDX-License-Identifier: Apache-2.0
#include "replay/replay_show.hpp"

#include <chrono>

#include "common/progress_line.hpp"
#include "common/replay.hpp"
#include "common/run_record.hpp"
#include "geoloc/io/output/output_frame.hpp"

namespace geoloc::apps {
namespace {

constexpr std::chrono::seconds kRecordPeriod{5};

}  // namespace

ReplayShow::ReplayShow(const ShowSource& source, Outputs& outputs, io::LivePage* page,
                       io::ReplayControl& playback)
    : source_(source),
      outputs_(outputs),
      page_(page),
      playback_(playback),
      reporter_(source.recording.class_names) {
  begin_anew();
}

void ReplayShow::begin_anew() {
  session_.emplace(source_.config);
  session_->note_damaged(source_.recording.frames_damaged);
  pace_.begin_anew();
  record_shown_at_.reset();
}

void ReplayShow::play_to_end(const StopSignal& stop) {
  while (!play_once(stop)) {
    begin_anew();
    if (page_ != nullptr) page_->begin_anew();
  }
}

void ReplayShow::play_again(const StopSignal& stop) {
  seek_to_ = playback_.take_seek();
  if (!seek_to_) return;
  begin_anew();
  page_->begin_anew();
  play_to_end(stop);
  show_end();
}

void ReplayShow::show_end() {
  if (page_ == nullptr) return;
  page_->add(record());
  page_->end();
}

io::RunRecord ReplayShow::record() const {
  io::RunRecord record = record_run(*session_, source_.recording.class_names, source_.truth, source_.title);
  outputs_.complete(record.objects);
  return record;
}

/// False where a reader of the page wants to go back.
bool ReplayShow::play_once(const StopSignal& stop) {
  const auto& frames = source_.recording.frames;
  ProgressLine progress("replaying", frames.size());
  std::size_t done = 0;
  bool goes_back = false;
  replay(source_.recording.telemetry, frames, *session_, [&](const PendingFrame& frame, bool is_located) {
    goes_back = !goes_on(frame.captured_at, stop);
    if (goes_back || stop.is_requested()) return false;
    if (++done > posted_) {
      posted_ = done;
      outputs_.post_frame(*session_, frame, is_located);
      tell_fleet();
    }
    if (page_ != nullptr) show(frame, is_located);
    progress.show(done);
    return true;
  });
  progress.finish();
  return !goes_back;
}

/// A flight that is played at its own pace tells its fleet now and then, as it did when it was flown.
void ReplayShow::tell_fleet() {
  const auto now = std::chrono::steady_clock::now();
  if (source_.outputs.mqtt.url.empty() || playback_.state().speed == 0.0) return;
  if (fleet_told_at_ && now - *fleet_told_at_ < kRecordPeriod) return;
  fleet_told_at_ = now;
  io::RunRecord run = record();
  add_summary(source_.outputs, *session_, run);
  outputs_.post_run(std::move(run));
}

/// Waits until the frame is due; false where a reader of the page wants to go back.
bool ReplayShow::goes_on(HostTime at, const StopSignal& stop) {
  while (!stop.is_requested()) {
    if (const auto seek = playback_.take_seek()) {
      seek_to_ = seek;
      if (*seek < at) return false;
    }
    if (is_seeking(at)) return true;
    if (seek_to_) pace_.begin_anew();
    seek_to_.reset();
    pace_.wait_for(at, [&]() -> std::optional<ReplayPace::Wish> {
      const io::ReplayControl::State wished = playback_.state();
      if (stop.is_requested() || wished.seek) return std::nullopt;
      if (page_ != nullptr) page_->show_playback(playback_.json(at, false));
      return ReplayPace::Wish{wished.speed, wished.is_paused};
    });
    if (!playback_.state().seek) return true;
  }
  return true;
}

void ReplayShow::show(const PendingFrame& frame, bool is_located) {
  io::OutputFrame report =
      reporter_.report(session_->geolocator(), is_located, frame.captured_at, frame.detections);
  outputs_.complete(report.objects);
  page_->add(report);
  page_->show_playback(playback_.json(frame.captured_at, is_seeking(frame.captured_at)));
  const auto now = std::chrono::steady_clock::now();
  const bool is_due = !record_shown_at_ || now - *record_shown_at_ >= kRecordPeriod;
  if (!is_located || !is_due || is_seeking(frame.captured_at)) return;
  record_shown_at_ = now;
  page_->add(record());
}

}  // namespace geoloc::apps
