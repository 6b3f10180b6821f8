// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "geoloc/geometry/time.hpp"

namespace geoloc::io {

/// One record of a MAVLink log; the bytes live in the Tlog it came from. They are framed but not checked: the
/// MAVLink decoder rejects frames with bad checksums.
struct TlogRecord {
  HostTime received_at;
  const std::uint8_t* frame;
  std::size_t size;
};

/// What stands before the frame in a record: big-endian UNIX microseconds.
std::array<std::uint8_t, 8> tlog_stamp(std::chrono::microseconds since_epoch);

/// A MAVLink log in memory: repeated 8-byte big-endian UNIX microseconds and one raw frame.
class Tlog {
 public:
  Tlog() = default;

  /// Splits the bytes into records. After a damaged record it continues at the next position that starts a
  /// plausible one.
  explicit Tlog(std::vector<std::uint8_t> bytes);

  const std::vector<TlogRecord>& records() const { return records_; }

  /// Bytes that belong to no record: damage, or the truncated end of a file.
  std::size_t skipped_bytes() const { return skipped_bytes_; }

  Tlog(Tlog&&) = default;
  Tlog& operator=(Tlog&&) = default;
  Tlog(const Tlog&) = delete;  // the records point into the bytes
  Tlog& operator=(const Tlog&) = delete;

 private:
  std::vector<std::uint8_t> bytes_;
  std::vector<TlogRecord> records_;
  std::size_t skipped_bytes_ = 0;
};

/// Throws std::runtime_error, naming the file, if it cannot be read or holds no record at all.
Tlog read_tlog(const std::filesystem::path& file);

}  // namespace geoloc::io
