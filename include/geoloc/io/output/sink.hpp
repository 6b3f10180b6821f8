// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "geoloc/io/output/live_status.hpp"
#include "geoloc/io/output/output_frame.hpp"
#include "geoloc/io/output/run_record.hpp"

namespace geoloc::io {

/// A place that results go to. A SinkRunner calls it from a thread of its own, one call at a time, so a sink
/// may block or throw (std::exception) without harm to the estimator or to other sinks. It overrides what it
/// has a use for.
class Sink {
 public:
  virtual ~Sink() = default;

  /// For messages: the option and its argument, "--kml run.kml".
  virtual std::string name() const = 0;

  /// Whether on_frame() and on_status() do anything.
  virtual bool wants_frames() const { return true; }

  /// After each frame, in order; some are left out for a sink that is too slow.
  virtual void on_frame(const OutputFrame& /*frame*/) {}

  /// Once a second of a live run, whether frames come or not.
  virtual void on_status(const LiveStatus& /*status*/) {}

  /// Every few seconds of a live run, and once after the last frame of any run.
  virtual void on_run(const RunRecord& /*run*/) {}

  /// The last call.
  virtual void on_end() {}

 protected:
  Sink() = default;
  Sink(const Sink&) = default;
  Sink& operator=(const Sink&) = default;
};

}  // namespace geoloc::io
