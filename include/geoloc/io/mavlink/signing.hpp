// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "geoloc/geometry/time.hpp"
#include "geoloc/io/mavlink/commands.hpp"
#include "geoloc/io/mavlink/frame.hpp"

// MAVLink 2's message signing: https://mavlink.io/en/guide/message_signing.html
namespace geoloc::io {

using SigningKey = std::array<std::uint8_t, 32>;

/// A key file's content: 32 bytes, or 64 hexadecimal digits with white space about them. nullopt for anything
/// else.
std::optional<SigningKey> parse_signing_key(const std::string& content);

/// The stamps that must only grow, over restarts too: a frame of before is not valid again. In units of 10 us
/// since 2015.
struct SigningStamps {
  std::uint64_t sent = 0;   ///< our last
  std::uint64_t heard = 0;  ///< the greatest of a valid frame
};

inline bool operator==(const SigningStamps& a, const SigningStamps& b) {
  return a.sent == b.sent && a.heard == b.heard;
}
inline bool operator!=(const SigningStamps& a, const SigningStamps& b) {
  return !(a == b);
}

/// The content of the file that keeps them, and back. nullopt for what to_text() does not write.
std::string to_text(const SigningStamps& stamps);
std::optional<SigningStamps> parse_signing_stamps(const std::string& content);

/// One end of a signed link. It does not allocate.
class LinkSigning {
 public:
  enum class Verdict {
    kValid,
    kUnsigned,
    kWrong,    ///< by another key, or damaged
    kRepeated  ///< its stamp is not after the sender's last one, or over a minute behind all others' (a new
               ///< sender), or there are too many senders to remember
  };

  /// `known`: as they were kept before, up to a minute ago.
  LinkSigning(const SigningKey& key, const SigningStamps& known);

  Verdict check(const Frame& frame) const;

  /// A valid frame was taken in: from now on it is a repeated one. What is refused for another reason must
  /// not be noted, lest a copy that comes first keeps the frame out.
  void note(const Frame& frame);

  /// The frame with our signature, stamped `now` or, if that is not after all stamps so far, just after them.
  /// A frame of MAVLink 1 has no place for it and stays as it is.
  OutgoingFrame sign(const OutgoingFrame& frame, HostTime now);

  const SigningStamps& stamps() const { return stamps_; }

 private:
  /// What one component sends on one of its links.
  struct Stream {
    MavAddress sender;
    std::uint8_t link = 0;
    std::uint64_t stamp = 0;
  };

  static constexpr std::size_t kStreams = 64;

  static Stream stream_of(const Frame& frame);
  const Stream* find(const Stream& arrived) const;

  SigningKey key_;
  SigningStamps stamps_;
  std::array<Stream, kStreams> streams_{};
  std::size_t count_ = 0;
};

}  // namespace geoloc::io
