// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

#include "geoloc/io/mavlink/frame_parser.hpp"
#include "geoloc/io/mavlink/link_source.hpp"
#include "geoloc/io/mavlink/mavlink_config.hpp"
#include "geoloc/io/mavlink/messages.hpp"
#include "geoloc/io/mavlink/signing.hpp"
#include "geoloc/io/mavlink/timesync_requests.hpp"
#include "geoloc/io/mavlink/vehicle_sources.hpp"

namespace geoloc::io {

/// The door of a live link, in both directions: what is refused here reaches neither the estimator nor the
/// recording, so that a replay needs no door. Refused are frames that are not signed by the key, where there
/// is one; those under an autopilot's address from a second source, while the first one sends its state; and
/// answers to TIMESYNC requests that were not made.
class LinkGuard {
 public:
  struct Counts {
    std::uint64_t admitted = 0;
    std::uint64_t unsigned_frames = 0;
    std::uint64_t wrong_signatures = 0;
    std::uint64_t repeated_signatures = 0;
    std::uint64_t second_source = 0;
    std::uint64_t unasked_timesyncs = 0;
    std::uint64_t refused_signatures() const {
      return unsigned_frames + wrong_signatures + repeated_signatures;
    }
  };

  /// A frame that may pass.
  using Admit = std::function<void(const std::uint8_t* frame, std::size_t size)>;

  /// `signing`: nullopt where nothing is signed and every frame may pass unsigned.
  explicit LinkGuard(const MavlinkConfig& config, const std::optional<LinkSigning>& signing = std::nullopt);

  /// Bytes of one source, in pieces of any size.
  void receive(HostTime now, const LinkSource& source, const std::uint8_t* data, std::size_t size,
               const Admit& admit);

  /// A frame of ours, as it is to be sent.
  OutgoingFrame outgoing(HostTime now, const std::uint8_t* frame, std::size_t size);

  const Counts& counts() const { return counts_; }
  const std::optional<VehicleSources::Refusal>& last_second_source() const { return sources_.last_refusal(); }
  /// When a frame last came that was not signed as it should be.
  const std::optional<HostTime>& last_refused_signature() const { return last_refused_signature_; }
  /// To be kept over restarts; nullopt where nothing is signed.
  std::optional<SigningStamps> signing_stamps() const;

 private:
  /// The beginning of a frame waits for the rest, which comes from the same source.
  struct Stream {
    std::optional<LinkSource> source;
    HostTime last_heard{};
    FrameParser parser;
  };

  static constexpr std::size_t kStreams = 16;

  Stream& stream_of(const LinkSource& source, HostTime now);
  bool admits(const Frame& frame, const LinkSource& source, HostTime now);
  bool is_signed_well(const Frame& frame, HostTime now);
  bool is_unasked(const Frame& frame, const Message& message);

  int component_id_;
  std::optional<LinkSigning> signing_;
  VehicleSources sources_;
  TimesyncRequests timesyncs_;
  std::array<Stream, kStreams> streams_;
  Counts counts_;
  std::optional<HostTime> last_refused_signature_;
};

}  // namespace geoloc::io
