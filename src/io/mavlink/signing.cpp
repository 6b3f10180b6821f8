// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/signing.hpp"

#include <all/mavlink.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>

#include "checksum.hpp"
#include "frame_format.hpp"
#include "geoloc/io/mavlink/message_table.hpp"

namespace geoloc::io {
namespace {

constexpr std::size_t kDigestSize = 6;  // of SHA-256, its first bytes
constexpr std::size_t kStampSize = 6;
static_assert(kSignatureSize == 1 + kStampSize + kDigestSize);
constexpr std::uint8_t kOurLink = 0;

/// The last stamp that six bytes hold.
constexpr std::uint64_t kLastStamp = (std::uint64_t{1} << 48) - 1;
constexpr std::uint64_t kMinute = 6'000'000;

using Digest = std::array<std::uint8_t, kDigestSize>;

Digest digest(const SigningKey& key, const std::uint8_t* bytes, std::size_t size) {
  mavlink_sha256_ctx context;
  mavlink_sha256_init(&context);
  mavlink_sha256_update(&context, key.data(), static_cast<std::uint32_t>(key.size()));
  mavlink_sha256_update(&context, bytes, static_cast<std::uint32_t>(size));
  Digest result;
  mavlink_sha256_final_48(&context, result.data());
  return result;
}

/// In the same time wherever they differ.
bool is_equal(const Digest& expected, const std::uint8_t* given) {
  std::uint8_t difference = 0;
  for (std::size_t i = 0; i < expected.size(); ++i)
    difference = static_cast<std::uint8_t>(difference | (expected[i] ^ given[i]));
  return difference == 0;
}

std::uint64_t read_stamp(const std::uint8_t* bytes) {
  std::uint64_t stamp = 0;
  for (std::size_t i = 0; i < kStampSize; ++i) stamp |= std::uint64_t{bytes[i]} << (8 * i);
  return stamp;
}

std::uint64_t stamp_of(HostTime time) {
  constexpr std::chrono::seconds kYear2015{1'420'070'400};
  constexpr std::chrono::microseconds kUnit{10};
  const Duration since = time.time_since_epoch() - kYear2015;
  return since > Duration::zero() ? static_cast<std::uint64_t>(since / kUnit) : 0;
}

std::optional<std::uint8_t> hexadecimal_digit(char c) {
  if (c >= '0' && c <= '9') return static_cast<std::uint8_t>(c - '0');
  if (c >= 'a' && c <= 'f') return static_cast<std::uint8_t>(c - 'a' + 10);
  if (c >= 'A' && c <= 'F') return static_cast<std::uint8_t>(c - 'A' + 10);
  return std::nullopt;
}

/// Takes "NAME NUMBER\n" off the text's beginning.
std::optional<std::uint64_t> take_line(std::string_view& text, std::string_view name) {
  if (text.substr(0, name.size()) != name) return std::nullopt;
  text.remove_prefix(name.size());
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  if (error != std::errc{} || number > kLastStamp || text.empty() || text.front() != '\n')
    return std::nullopt;
  text.remove_prefix(1);
  return number;
}

}  // namespace

std::optional<SigningKey> parse_signing_key(const std::string& content) {
  SigningKey key;
  if (content.size() == key.size()) {
    std::copy(content.begin(), content.end(), key.begin());
    return key;
  }
  constexpr const char* kSpace = " \t\r\n";
  const std::size_t begin = content.find_first_not_of(kSpace);
  if (begin == std::string::npos) return std::nullopt;
  const std::string_view digits =
      std::string_view(content).substr(begin, content.find_last_not_of(kSpace) + 1 - begin);
  if (digits.size() != 2 * key.size()) return std::nullopt;
  for (std::size_t i = 0; i < key.size(); ++i) {
    const auto high = hexadecimal_digit(digits[2 * i]), low = hexadecimal_digit(digits[2 * i + 1]);
    if (!high || !low) return std::nullopt;
    key[i] = static_cast<std::uint8_t>(*high << 4 | *low);
  }
  return key;
}

std::string to_text(const SigningStamps& stamps) {
  return "sent " + std::to_string(stamps.sent) + "\nheard " + std::to_string(stamps.heard) + "\n";
}

std::optional<SigningStamps> parse_signing_stamps(const std::string& content) {
  std::string_view text = content;
  const auto sent = take_line(text, "sent ");
  const auto heard = sent ? take_line(text, "heard ") : std::nullopt;
  if (!heard || !text.empty()) return std::nullopt;
  return SigningStamps{*sent, *heard};
}

LinkSigning::LinkSigning(const SigningKey& key, const SigningStamps& known) : key_(key), stamps_(known) {
  if (stamps_.sent > 0) stamps_.sent += kMinute;
}

LinkSigning::Verdict LinkSigning::check(const Frame& frame) const {
  if (!frame.is_signed || frame.size < kSignatureSize) return Verdict::kUnsigned;
  const std::uint8_t* const end = frame.bytes + frame.size;
  if (!is_equal(digest(key_, frame.bytes, frame.size - kDigestSize), end - kDigestSize))
    return Verdict::kWrong;
  const Stream arrived = stream_of(frame);
  const Stream* const known = find(arrived);
  const bool is_new = known != nullptr ? arrived.stamp > known->stamp
                                       : count_ < kStreams && arrived.stamp + kMinute >= stamps_.heard;
  return is_new ? Verdict::kValid : Verdict::kRepeated;
}

void LinkSigning::note(const Frame& frame) {
  const Stream arrived = stream_of(frame);
  const Stream* const known = find(arrived);
  if (known == nullptr && count_ == kStreams) return;
  streams_[known != nullptr ? static_cast<std::size_t>(known - streams_.data()) : count_++] = arrived;
  stamps_.heard = std::max(stamps_.heard, arrived.stamp);
}

/// The frame must be signed.
LinkSigning::Stream LinkSigning::stream_of(const Frame& frame) {
  const std::uint8_t* const signature = frame.bytes + frame.size - kSignatureSize;
  return {frame.sender, signature[0], read_stamp(signature + 1)};
}

const LinkSigning::Stream* LinkSigning::find(const Stream& arrived) const {
  const Stream* const end = streams_.data() + count_;
  const Stream* const known = std::find_if(streams_.data(), end, [&](const Stream& stream) {
    return stream.sender == arrived.sender && stream.link == arrived.link;
  });
  return known != end ? known : nullptr;
}

OutgoingFrame LinkSigning::sign(const OutgoingFrame& frame, HostTime now) {
  const bool has_room = frame.size >= kHeaderSizeV2 + kChecksumSize && frame.bytes[0] == kMagicV2 &&
                        (frame.bytes[2] & kSignedFlag) == 0 &&
                        frame.size + kSignatureSize <= frame.bytes.size();
  if (!has_room) return frame;
  const std::uint32_t message_id =
      static_cast<std::uint32_t>(frame.bytes[7] | frame.bytes[8] << 8 | frame.bytes[9] << 16);
  const auto spec = message_spec(message_id);
  if (!spec) return frame;
  OutgoingFrame is_signed = frame;
  std::uint8_t* const bytes = is_signed.bytes.data();
  bytes[2] |= kSignedFlag;
  std::uint8_t* next = bytes + frame.size - kChecksumSize;
  Checksum checksum;
  std::for_each(bytes + 1, next, [&](std::uint8_t byte) { checksum.add(byte); });
  checksum.add(spec->checksum_seed);
  *next++ = static_cast<std::uint8_t>(checksum.value());
  *next++ = static_cast<std::uint8_t>(checksum.value() >> 8);
  stamps_.sent = std::min(std::max({stamp_of(now), stamps_.sent + 1, stamps_.heard + 1}), kLastStamp);
  *next++ = kOurLink;
  for (std::size_t i = 0; i < kStampSize; ++i) *next++ = static_cast<std::uint8_t>(stamps_.sent >> (8 * i));
  const Digest ours = digest(key_, bytes, static_cast<std::size_t>(next - bytes));
  std::copy(ours.begin(), ours.end(), next);
  is_signed.size = frame.size + kSignatureSize;
  return is_signed;
}

}  // namespace geoloc::io
