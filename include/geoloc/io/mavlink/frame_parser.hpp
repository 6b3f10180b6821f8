// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "geoloc/io/mavlink/frame.hpp"
#include "geoloc/io/mavlink/sequence_tracker.hpp"

namespace geoloc::io {

/// Every byte is part of a frame, part of an unknown frame, or junk; the cause of junk may be a bad frame.
struct FrameCounts {
  std::uint64_t frames = 0;         ///< checked and handed out
  std::uint64_t signed_frames = 0;  ///< of those, with a signature (not verified)
  std::uint64_t bad_frames = 0;     ///< the header of a known message, but a checksum or length that is wrong
  std::uint64_t unknown_frames = 0;  ///< of unknown messages: ignored, as they cannot be checked
  std::uint64_t junk_bytes = 0;
};

/// Finds MAVLink 1 and 2 frames in a stream of bytes: append() what came in, then take next() until it is
/// empty.
///
/// A good frame is found whatever came before it: after a wrong checksum the search goes on one byte further,
/// not behind the length that a damaged header claimed. The price: a truncated frame is recognised only when
/// as many bytes have followed as its header announces (280 at most), and the frames after it wait as long.
/// Signatures are skipped, not verified. The parser does not allocate and has no state outside the object.
class FrameParser {
 public:
  /// Takes in as much as there is room for and returns how much that was: at least one byte of a non-empty
  /// input, once next() has been emptied. Frames handed out before become invalid.
  std::size_t append(const std::uint8_t* data, std::size_t size);

  /// The next whole frame whose checksum is right, if there is one; valid until the next append().
  std::optional<Frame> next();

  const FrameCounts& counts() const { return counts_; }
  const SequenceTracker& sequences() const { return sequences_; }

 private:
  static constexpr std::size_t kCapacity = 4096;

  /// The bytes claimed by the header of a frame that was not returned: a bad frame, or one of an unknown
  /// message, which is taken for a frame if no good one starts within it. Bad frames inside these bytes are
  /// not counted again.
  struct Claim {
    bool is_unknown = false;
    MavAddress sender;
    std::uint8_t sequence = 0;
    std::size_t size = 0;
    std::size_t left = 0;  ///< bytes still to pass; 0: no claim
  };

  void claim(const Frame& header, bool is_unknown);
  void pass_byte();
  void take(const Frame& frame);

  std::array<std::uint8_t, kCapacity> buffer_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  Claim claim_;
  FrameCounts counts_;
  SequenceTracker sequences_;
};

}  // namespace geoloc::io
