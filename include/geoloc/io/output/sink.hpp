// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "geoloc/io/output/live_status.hpp"
#include "geoloc/io/output/output_frame.hpp"
#include "geoloc/io/output/run_record.hpp"

namespace geoloc::io {

/// A destination of results. A SinkRunner calls it from a thread of its own, one call at a time, so a sink
/// may block or throw (std::exception) without harm to the estimator or to other sinks. It overrides the
/// functions that it needs.
class Sink {
 public:
  virtual ~Sink() = default;

  /// For messages: the option and its argument, "--kml run.kml".
  virtual std::string name() const = 0;

  /// Whether on_frame() and on_status() do anything.
  virtual bool wants_frames() const { return true; }

  /// Called after each frame, in order; frames are dropped for a sink that is too slow.
  virtual void on_frame(const OutputFrame& /*frame*/) {}

  /// Called once per second in a live run, whether or not frames arrive.
  virtual void on_status(const LiveStatus& /*status*/) {}

  /// Called every few seconds in a live run, and once after the last frame of any run.
  virtual void on_run(const RunRecord& /*run*/) {}

  /// The last call.
  virtual void on_end() {}

 protected:
  Sink() = default;
  Sink(const Sink&) = default;
  Sink& operator=(const Sink&) = default;
};

}  // namespace geoloc::io
