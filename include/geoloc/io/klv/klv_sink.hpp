// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "geoloc/io/klv/held_video.hpp"
#include "geoloc/io/klv/transport_stream.hpp"
#include "geoloc/io/output/result_file.hpp"
#include "geoloc/io/output/sink.hpp"

namespace geoloc::io {

/// Writes a run as an MPEG transport stream: what each frame shows as MISB ST 0601, beside the video that it
/// is a frame of, which is passed on as it came; a picture for which no metadata comes is not held back for
/// long. In a live run, a power cut costs the last second of a file.
class KlvSink final : public Sink {
 public:
  /// `target` is udp://HOST:PORT or a file. `video` is the run's; nullptr: it has none. Throws
  /// std::invalid_argument for a bad target, std::runtime_error for a host that cannot be found, or where an
  /// element of GStreamer is missing.
  KlvSink(std::string target, OldFile old_file, TellUser tell, std::shared_ptr<HeldVideo> video);
  ~KlvSink() override;

  std::string name() const override;
  void on_frame(const OutputFrame& frame) override;
  void on_status(const LiveStatus& status) override;
  void on_end() override;

 private:
  class Destination;

  void begin(const HeldVideo::Pictures& pictures);
  void write(const HeldVideo::Pictures& pictures);
  void write_alone(const HeldVideo::Pictures& pictures);
  Duration shown_at(HostTime captured_at);
  template <typename Step>
  void attempt(const Step& step);

  TellUser tell_;
  std::shared_ptr<HeldVideo> video_;
  std::unique_ptr<Destination> destination_;
  std::unique_ptr<TransportStream> stream_;  // nullptr until there is something to write
  bool has_video_ = false;                   // of the stream
  bool has_failed_ = false;
  bool has_told_loss_ = false;
  std::optional<HostTime> first_captured_at_;
  Duration newest_{};  // in the stream
};

}  // namespace geoloc::io
