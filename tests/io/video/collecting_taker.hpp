// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <mutex>
#include <string>
#include <vector>

#include "geoloc/io/encoded_video.hpp"

namespace geoloc::io::test {

/// Keeps what a source hands on of its video.
class CollectingTaker final : public EncodedVideoTaker {
 public:
  struct Note {
    HostTime captured_at;
    Duration shown_at;
  };

  void add(EncodedPicture picture) override {
    const std::lock_guard lock(mutex_);
    pictures_.push_back(std::move(picture));
  }
  void note_frame(HostTime captured_at, Duration shown_at) override {
    const std::lock_guard lock(mutex_);
    notes_.push_back({captured_at, shown_at});
  }

  std::vector<EncodedPicture> pictures() const {
    const std::lock_guard lock(mutex_);
    return pictures_;
  }
  std::vector<Note> notes() const {
    const std::lock_guard lock(mutex_);
    return notes_;
  }

  /// Whether every frame is one of the pictures.
  bool knows_all_frames() const {
    const std::lock_guard lock(mutex_);
    return std::all_of(notes_.begin(), notes_.end(), [this](const Note& note) {
      return std::any_of(pictures_.begin(), pictures_.end(), [&note](const EncodedPicture& picture) {
        return picture.shown_at == note.shown_at;
      });
    });
  }

 private:
  mutable std::mutex mutex_;
  std::vector<EncodedPicture> pictures_;
  std::vector<Note> notes_;
};

}  // namespace geoloc::io::test
