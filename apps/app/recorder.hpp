// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "geoloc/io/recording/recording_writer.hpp"

namespace geoloc::apps {

/// A recording that may fail without taking the run with it: the first error ends it and is told once.
class Recorder {
 public:
  /// No recording where `folder` is empty. Throws std::runtime_error if it cannot begin.
  explicit Recorder(const std::string& folder);

  /// Calls step(writer) unless recording has ended.
  template <typename Step>
  void write(const Step& step) {
    if (!writer_) return;
    try {
      step(*writer_);
    } catch (const std::exception& error) {
      give_up(error.what());
    }
  }

  std::uint64_t telemetry_records() const { return writer_ ? writer_->telemetry_records() : 0; }
  bool has_failed() const { return has_failed_; }
  void finish();

 private:
  void give_up(const char* reason);

  std::optional<io::RecordingWriter> writer_;
  bool has_failed_ = false;
};

}  // namespace geoloc::apps
