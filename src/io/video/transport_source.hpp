// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace geoloc::io {

/// Names the server's address in the Transport headers of its answers, where it does not itself: rtspsrc
/// sends its RTCP there, and would otherwise send it to the relay. Bytes pass at once, but for a line that
/// may be such a header. Takes any bytes.
class TransportSource {
 public:
  explicit TransportSource(std::string address) : address_(std::move(address)) {}

  std::string edit(std::string_view bytes);

 private:
  std::string address_;
  std::string held_;              // the line's beginning, while it may be a Transport header
  bool is_line_passing_ = false;  // the rest of this line is no header
};

}  // namespace geoloc::io
