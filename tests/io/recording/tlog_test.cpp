// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/recording/tlog.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/temporary_folder.hpp"

namespace geoloc::io {
namespace {

using Bytes = std::vector<std::uint8_t>;

void append_record(Bytes& log, std::int64_t stamp_us, const Bytes& frame) {
  for (int shift = 56; shift >= 0; shift -= 8)
    log.push_back(static_cast<std::uint8_t>(stamp_us >> shift & 0xFF));
  log.insert(log.end(), frame.begin(), frame.end());
}

Bytes frame_v1(std::size_t payload) {
  Bytes frame(payload + 8, 0x11);
  frame[0] = 0xFE;
  frame[1] = static_cast<std::uint8_t>(payload);
  return frame;
}

Bytes frame_v2(std::size_t payload, bool is_signed) {
  Bytes frame(payload + 12 + (is_signed ? 13 : 0), 0x22);
  frame[0] = 0xFD;
  frame[1] = static_cast<std::uint8_t>(payload);
  frame[2] = is_signed ? 1 : 0;
  return frame;
}

constexpr std::int64_t kStamp_us = 1'700'000'000'000'000;

TEST(Tlog, FramesBothVersionsAndSignatures) {
  Bytes log;
  append_record(log, kStamp_us, frame_v1(9));
  append_record(log, kStamp_us + 5, frame_v2(28, false));
  append_record(log, kStamp_us - 7, frame_v2(0, true));  // stamps of real logs jump
  const Tlog tlog(log);
  ASSERT_EQ(tlog.records().size(), 3U);
  EXPECT_EQ(tlog.records()[0].size, 17U);
  EXPECT_EQ(tlog.records()[1].size, 40U);
  EXPECT_EQ(tlog.records()[2].size, 25U);
  EXPECT_EQ(tlog.records()[2].received_at.time_since_epoch(), std::chrono::microseconds{kStamp_us - 7});
  EXPECT_EQ(tlog.skipped_bytes(), 0U);
}

TEST(Tlog, GoesOnAfterDamage) {
  Bytes log;
  append_record(log, kStamp_us, frame_v1(9));
  log.insert(log.end(), 23, 0xFE);  // looks like the start of a frame, again and again
  for (int i = 0; i < 10; ++i) append_record(log, kStamp_us + i, frame_v2(20, false));
  const Tlog tlog(log);
  EXPECT_EQ(tlog.records().size(), 11U);
  EXPECT_EQ(tlog.skipped_bytes(), 23U);
}

TEST(Tlog, LeavesOutTheCutEnd) {
  Bytes log;
  append_record(log, kStamp_us, frame_v1(9));
  append_record(log, kStamp_us, frame_v1(200));
  log.resize(log.size() - 50);
  EXPECT_EQ(Tlog(log).records().size(), 1U);
}

TEST(Tlog, SurvivesAnyBytes) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 200; ++trial) {
    Bytes log(random() % 600);
    for (auto& byte : log) byte = static_cast<std::uint8_t>(random() % 3 == 0 ? 0xFD : random());
    const Tlog tlog(log);
    std::size_t framed = 0;
    for (const TlogRecord& record : tlog.records()) framed += 8 + record.size;
    EXPECT_EQ(framed + tlog.skipped_bytes(), log.size());
  }
}

TEST(Tlog, FileWithoutRecordsIsRefusedByName) {
  const testing::TemporaryFolder folder;
  const auto file = folder.write("telemetry.tlog", "no telemetry at all");
  EXPECT_THROW(read_tlog(file), std::runtime_error);
  EXPECT_THROW(read_tlog(folder.path() / "none.tlog"), std::runtime_error);
}

}  // namespace
}  // namespace geoloc::io
