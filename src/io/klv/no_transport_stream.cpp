// SPDX-License-Identifier: Apache-2.0
#include <stdexcept>

#include "geoloc/io/klv/transport_stream.hpp"

// In builds without GStreamer.
namespace geoloc::io {

class TransportStream::Impl {};

void TransportStream::require() {
  throw std::runtime_error(
      "--klv: this build does not write transport streams: build geoloc with GStreamer "
      "(apt-get install libgstreamer1.0-dev libgstreamer-plugins-base1.0-dev)");
}

TransportStream::TransportStream(std::string /*name*/, const std::string& /*video_format*/, Write /*write*/) {
  require();
}

TransportStream::~TransportStream() = default;
void TransportStream::add(const EncodedPicture& /*picture*/) {}
void TransportStream::add_metadata(const std::string& /*set*/, Duration /*shown_at*/) {}
void TransportStream::none_until(Duration /*shown_at*/) {}
void TransportStream::finish() {}

}  // namespace geoloc::io
