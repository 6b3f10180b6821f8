// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "geoloc/geometry/time.hpp"
#include "geoloc/io/encoded_video.hpp"

namespace geoloc::io {

/// An MPEG transport stream of KLV metadata, asynchronous as in MISB ST 1402 but with presentation times, and
/// of the video that it belongs to. Video and metadata are in order of their times: what is later than the
/// newest metadata waits, until there is more or none_until() says that there will be none.
class TransportStream {
 public:
  /// Takes whole packets of 188 bytes, seven of them at a time: as many as a datagram holds. Called from
  /// another thread; what it throws ends the stream.
  using Write = std::function<void(std::string_view packets)>;

  /// Throws std::runtime_error naming the element of GStreamer that is missing, and its package.
  static void require();

  /// `name` is for messages. `video_format` is that of the pictures (EncodedPicture::format); empty: there is
  /// no video. Throws std::runtime_error where it is neither H.264 nor H.265.
  TransportStream(std::string name, const std::string& video_format, Write write);
  ~TransportStream();
  TransportStream(const TransportStream&) = delete;
  TransportStream& operator=(const TransportStream&) = delete;

  // Each of these throws where the stream has ended: what `write` threw, or std::runtime_error with the
  // reason.

  /// In the order of decoding. Waits while much has yet to be written.
  void add(const EncodedPicture& picture);

  /// In order of their times.
  void add_metadata(const std::string& set, Duration shown_at);
  void none_until(Duration shown_at);

  /// Writes the rest, for some seconds at most.
  void finish();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace geoloc::io
