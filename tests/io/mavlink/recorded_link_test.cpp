// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

#include "geoloc/io/mavlink/vehicle_link.hpp"
#include "geoloc/io/recording/tlog.hpp"
#include "io/mavlink/collecting_sink.hpp"
#include "io/mavlink/fixture_files.hpp"

namespace geoloc::io {
namespace {

using testing::CollectingSink;

LinkStatus play(const Tlog& log, CollectingSink& sink) {
  VehicleLink link{MavlinkConfig{}};
  for (const TlogRecord& record : log.records())
    link.consume(record.received_at, record.frame, record.size, sink);
  return link.status(log.records().back().received_at);
}

std::map<std::string, std::uint64_t> by_name(const LinkStatus& status) {
  return {{"frames", status.frames.frames},
          {"bad_frames", status.frames.bad_frames},
          {"vehicle_frames", status.telemetry.vehicle_frames},
          {"foreign_frames", status.telemetry.foreign_frames},
          {"lost_frames", status.lost_frames},
          {"attitudes", status.telemetry.attitudes},
          {"positions", status.telemetry.positions},
          {"no_fix_positions", status.telemetry.no_fix_positions},
          {"suspect_stamps", status.telemetry.suspect_stamps},
          {"reboots", status.telemetry.reboots}};
}

TEST(RecordedLink, CountsTheFaultsOfARadioLinkOneByOne) {
  CollectingSink sink;
  const auto counted = by_name(play(read_tlog(testing::fixture("faults.tlog")), sink));
  const auto expected = testing::read_csv(testing::fixture("faults.counts.csv"));
  ASSERT_EQ(expected.size(), counted.size());
  for (const auto& row : expected) EXPECT_EQ(counted.at(row[0]), std::stoull(row[1])) << row[0];
}

TEST(RecordedLink, DeliversNothingOfOthersAndNothingBeforeTheFix) {
  CollectingSink sink;
  play(read_tlog(testing::fixture("faults.tlog")), sink);
  EXPECT_EQ(sink.reboots_at.size(), 1U);
  for (const AttitudeSample& sample : sink.attitudes) {
    EXPECT_LE(std::abs(sample.angles.roll_rad), 0.2001) << "others roll by 1 rad";
  }
  for (const PositionSample& sample : sink.positions) EXPECT_LT(sample.position.latitude_deg, -22.0);
  const std::size_t reboot = sink.attitudes_before_reboot.at(0);
  for (std::size_t i = 1; i < sink.attitudes.size(); ++i) {
    EXPECT_EQ(sink.attitudes[i].time < sink.attitudes[i - 1].time, i == reboot) << i;
  }
}

TEST(RecordedLink, FindsEveryGoodFrameWithoutTheLogsFraming) {
  // The whole file as one stream of bytes: to the parser, time stamps are junk, and corrupt frames are not
  // marked.
  std::ifstream file(testing::fixture("faults.tlog"), std::ios::binary);
  const testing::Bytes bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  CollectingSink framed, streamed;
  play(read_tlog(testing::fixture("faults.tlog")), framed);
  VehicleLink link{MavlinkConfig{}};
  link.consume(HostTime{std::chrono::hours{1}}, bytes.data(), bytes.size(), streamed);
  EXPECT_EQ(streamed.frames.size(), framed.frames.size());
  EXPECT_EQ(streamed.attitudes.size(), framed.attitudes.size());
  EXPECT_EQ(streamed.positions.size(), framed.positions.size());
}

TEST(RecordedLink, PlaysAMavlink1Link) {
  CollectingSink sink;
  const LinkStatus status = play(read_tlog(testing::fixture("link_v1.tlog")), sink);
  EXPECT_EQ(status.vehicle, (MavAddress{1, 1}));
  EXPECT_FALSE(status.is_v2);
  EXPECT_GT(status.telemetry.attitudes, 5U);
  EXPECT_EQ(status.frames.bad_frames, 0U);
}

/// Any log: GEOLOC_REAL_LOG=FILE.tlog io_mavlink_test --gtest_filter='*RealLog*' prints what was counted in
/// it.
TEST(RecordedLink, RealLogPlays) {
  const char* const file = std::getenv("GEOLOC_REAL_LOG");
  if (file == nullptr) GTEST_SKIP() << "set GEOLOC_REAL_LOG to a .tlog";
  CollectingSink sink;
  const LinkStatus status = play(read_tlog(file), sink);
  for (const auto& [name, count] : by_name(status)) std::printf("%-18s %llu\n", name.c_str(), 0ULL + count);
  std::printf("%-18s %llu\n", "unknown_frames", 0ULL + status.frames.unknown_frames);
  std::printf("%-18s %llu\n", "junk_bytes", 0ULL + status.frames.junk_bytes);
  std::printf("%-18s %llu\n", "refused_values", 0ULL + status.telemetry.refused_values);
  for (const HostTime at : sink.reboots_at) {
    std::printf("reboot seen after  %.1f s\n", seconds(at - sink.frames.front().at));
  }
  EXPECT_TRUE(status.vehicle);
}

}  // namespace
}  // namespace geoloc::io
