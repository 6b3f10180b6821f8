// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "geoloc/io/recording/recording_writer.hpp"

namespace geoloc::apps {

/// Records a run without harm to it. A thread of its own writes ten times per second and makes what it wrote
/// survive a power cut once per second, so no call waits for the disk. What comes while too much waits is
/// left out and counted. The first error ends the recording, not the run. take_messages() tells all of that.
class Recorder {
 public:
  using Write = std::function<void(io::RecordingWriter& writer)>;

  static constexpr std::size_t kMostWaiting_bytes = 32 << 20;  ///< minutes of a usual flight

  /// No recording where `folder` is empty; under another name where that one is taken. `write_settings` is
  /// called at once: what it writes is safe when this returns. Throws std::runtime_error where the name
  /// cannot be used; a full disk only ends the recording.
  Recorder(const std::string& folder, const Write& write_settings,
           std::size_t most_waiting_bytes = kMostWaiting_bytes);
  /// finish().
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  void add_telemetry(HostTime received_at, const std::uint8_t* frame, std::size_t size);
  void add_frame(io::RecordedFrame frame);
  void add_note(io::NotedObject noted);
  /// An object's best picture so far, a JPEG. From any thread.
  void add_picture(std::uint64_t object_id, const std::string& jpeg);
  /// The object is gone, and so is its picture. From any thread.
  void remove_picture(std::uint64_t object_id);

  /// Records of telemetry that were taken so far (io::RecordedFrame::telemetry_records).
  std::uint64_t telemetry_records() const { return telemetry_records_; }

  /// For the user, since the last call.
  std::vector<std::string> take_messages();

  /// Waits for the disk while it makes progress; one that makes none for ten seconds is abandoned.
  /// `write_last` may be called after this returns, then.
  void finish(Write write_last = {});

  /// The recording has ended early or is not whole. Final after finish().
  bool has_failed() const;

 private:
  struct State;

  std::shared_ptr<State> state_;  // the thread's too: it may outlive this object. nullptr: no recording
  std::thread thread_;
  std::uint64_t telemetry_records_ = 0;
};

}  // namespace geoloc::apps
