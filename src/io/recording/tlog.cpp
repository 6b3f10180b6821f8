// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/recording/tlog.hpp"

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace geoloc::io {
namespace {

constexpr std::size_t kStampSize = 8;
constexpr std::uint8_t kMagicV1 = 0xFE;
constexpr std::uint8_t kMagicV2 = 0xFD;
constexpr std::uint8_t kSignedFlag = 0x01;

/// Size of the frame that starts at `frame`, from its header alone; 0 where none does.
std::size_t frame_size(const std::uint8_t* frame, std::size_t available) {
  constexpr std::size_t kOverheadV1 = 8, kOverheadV2 = 12, kSignature = 13;
  if (available < 3) return 0;
  std::size_t size = 0;
  if (frame[0] == kMagicV1) size = kOverheadV1 + frame[1];
  if (frame[0] == kMagicV2) size = kOverheadV2 + frame[1] + ((frame[2] & kSignedFlag) != 0 ? kSignature : 0);
  return size <= available ? size : 0;
}

std::int64_t big_endian_microseconds(const std::uint8_t* bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < kStampSize; ++i) value = value << 8 | bytes[i];
  return static_cast<std::int64_t>(value);
}

/// Time stamps are plausible between 1970 and 2200, within the range of nanoseconds in 64 bits.
bool is_plausible_stamp(std::int64_t stamp_us) {
  return stamp_us >= 0 && stamp_us < 7'258'118'400'000'000;
}

/// Size of the record (stamp and frame) at `offset`; 0 where none starts.
std::size_t record_size(const std::vector<std::uint8_t>& bytes, std::size_t offset) {
  if (bytes.size() - offset <= kStampSize) return 0;
  if (!is_plausible_stamp(big_endian_microseconds(&bytes[offset]))) return 0;
  const std::size_t size = frame_size(&bytes[offset + kStampSize], bytes.size() - offset - kStampSize);
  return size == 0 ? 0 : kStampSize + size;
}

/// After damage a single magic byte proves little: the record must be followed by another one, or by the end.
bool starts_chain(const std::vector<std::uint8_t>& bytes, std::size_t offset) {
  const std::size_t size = record_size(bytes, offset);
  if (size == 0) return false;
  const std::size_t next = offset + size;
  return next == bytes.size() || record_size(bytes, next) != 0;
}

}  // namespace

std::array<std::uint8_t, kStampSize> tlog_stamp(std::chrono::microseconds since_epoch) {
  std::array<std::uint8_t, kStampSize> bytes{};
  auto rest = static_cast<std::uint64_t>(since_epoch.count());
  for (auto byte = bytes.rbegin(); byte != bytes.rend(); ++byte, rest >>= 8U)
    *byte = static_cast<std::uint8_t>(rest & 0xFFU);
  return bytes;
}

Tlog::Tlog(std::vector<std::uint8_t> bytes) : bytes_(std::move(bytes)) {
  std::size_t offset = 0;
  bool in_step = true;
  while (offset < bytes_.size()) {
    const std::size_t size = record_size(bytes_, offset);
    if (size == 0 || (!in_step && !starts_chain(bytes_, offset))) {
      in_step = false;
      ++skipped_bytes_;
      ++offset;
      continue;
    }
    in_step = true;
    const HostTime received_at{std::chrono::microseconds{big_endian_microseconds(&bytes_[offset])}};
    records_.push_back({received_at, &bytes_[offset + kStampSize], size - kStampSize});
    offset += size;
  }
}

Tlog read_tlog(const std::filesystem::path& file) {
  std::ifstream input(file, std::ios::binary);
  if (!input) throw std::runtime_error(file.string() + ": cannot be opened");
  std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(input), std::istreambuf_iterator<char>()};
  if (input.bad()) throw std::runtime_error(file.string() + ": cannot be read");
  Tlog log(std::move(bytes));
  if (log.records().empty()) {
    throw std::runtime_error(file.string() + ": holds no MAVLink record (8-byte stamp and frame)");
  }
  return log;
}

}  // namespace geoloc::io
