// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/frame_parser.hpp"

#include <algorithm>

#include "checksum.hpp"
#include "frame_format.hpp"
#include "geoloc/io/mavlink/message_table.hpp"

namespace geoloc::io {
namespace {

enum class Finding { kFrame, kBadFrame, kUnknownMessage, kNoFrame, kNeedsMoreBytes };

/// Interprets the bytes as a frame by the header alone; kNoFrame if they cannot be one.
Finding read_header(const std::uint8_t* bytes, std::size_t available, Frame& frame) {
  frame.is_v2 = bytes[0] == kMagicV2;
  if (!frame.is_v2 && bytes[0] != kMagicV1) return Finding::kNoFrame;
  if (frame.is_v2 && available > 2 && (bytes[2] & ~kSignedFlag) != 0) return Finding::kNoFrame;
  const std::size_t header_size = frame.is_v2 ? kHeaderSizeV2 : kHeaderSizeV1;
  if (available < header_size) return Finding::kNeedsMoreBytes;
  frame.bytes = bytes;
  frame.payload = bytes + header_size;
  frame.payload_size = bytes[1];
  frame.is_signed = frame.is_v2 && bytes[2] == kSignedFlag;
  frame.size = header_size + frame.payload_size + kChecksumSize + (frame.is_signed ? kSignatureSize : 0);
  const std::uint8_t* const address = bytes + (frame.is_v2 ? 4 : 2);
  frame.sequence = address[0];
  frame.sender = {address[1], address[2]};
  frame.message_id = address[3];
  if (frame.is_v2) frame.message_id |= static_cast<std::uint32_t>(address[4] << 8 | address[5] << 16);
  return Finding::kFrame;
}

bool has_right_checksum(const Frame& frame, std::uint8_t seed) {
  const std::uint8_t* const checksum = frame.payload + frame.payload_size;
  Checksum expected;
  for (const std::uint8_t* byte = frame.bytes + 1; byte != checksum; ++byte) expected.add(*byte);
  expected.add(seed);
  return (checksum[0] | checksum[1] << 8) == expected.value();
}

Finding inspect(const std::uint8_t* bytes, std::size_t available, Frame& frame) {
  const Finding header = read_header(bytes, available, frame);
  if (header != Finding::kFrame) return header;
  const auto spec = message_spec(frame.message_id);
  if (!spec) return Finding::kUnknownMessage;
  // MAVLink 1 does not truncate zeros (and should not carry extensions, but pymavlink sends them), so an
  // impossible size is detected without waiting for the bytes.
  const bool is_possible_v1 = frame.payload_size >= spec->base_size && frame.payload_size <= spec->full_size;
  if (!frame.is_v2 && !is_possible_v1) return Finding::kBadFrame;
  if (available < frame.size) return Finding::kNeedsMoreBytes;
  return has_right_checksum(frame, spec->checksum_seed) ? Finding::kFrame : Finding::kBadFrame;
}

}  // namespace

std::size_t FrameParser::append(const std::uint8_t* data, std::size_t size) {
  std::copy(buffer_.begin() + begin_, buffer_.begin() + end_, buffer_.begin());
  end_ -= begin_;
  begin_ = 0;
  const std::size_t taken = std::min(size, kCapacity - end_);
  std::copy_n(data, taken, buffer_.begin() + end_);
  end_ += taken;
  return taken;
}

std::optional<Frame> FrameParser::next() {
  while (begin_ < end_) {
    Frame frame;
    switch (inspect(&buffer_[begin_], end_ - begin_, frame)) {
      case Finding::kFrame:
        take(frame);
        return frame;
      case Finding::kNeedsMoreBytes:
        return std::nullopt;
      case Finding::kBadFrame:
        claim(frame, false);
        break;
      case Finding::kUnknownMessage:
        claim(frame, true);
        break;
      case Finding::kNoFrame:
        break;
    }
    pass_byte();
  }
  return std::nullopt;
}

void FrameParser::claim(const Frame& header, bool is_unknown) {
  if (claim_.left > 0) return;
  claim_ = {is_unknown, header.sender, header.sequence, header.size, header.size};
  if (!is_unknown) ++counts_.bad_frames;
}

void FrameParser::pass_byte() {
  ++begin_;
  if (!claim_.is_unknown) ++counts_.junk_bytes;
  if (claim_.left == 0 || --claim_.left > 0) return;
  if (claim_.is_unknown) {
    ++counts_.unknown_frames;
    sequences_.observe_unchecked(claim_.sender, claim_.sequence);
  }
  claim_ = {};
}

void FrameParser::take(const Frame& frame) {
  if (claim_.is_unknown && claim_.left > 0) counts_.junk_bytes += claim_.size - claim_.left;
  claim_ = {};
  begin_ += frame.size;
  ++counts_.frames;
  if (frame.is_signed) ++counts_.signed_frames;
  sequences_.observe(frame.sender, frame.sequence);
}

}  // namespace geoloc::io
