// SPDX-License-Identifier: Apache-2.0
// What the streams hold is tested with readers of others (tests/apps/klv_test.py).
#include "geoloc/io/klv/klv_sink.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "geoloc/io/klv/klv_target.hpp"
#include "support/temporary_folder.hpp"

namespace geoloc::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPacket = 188;

std::string content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

OutputFrame frame_at(int second) {
  OutputFrame frame;
  frame.captured_at = HostTime{std::chrono::seconds{1700000000 + second}};
  return frame;
}

/// A run of so many frames to a file; what it told.
std::vector<std::string> run_to(const fs::path& file, int frames, OldFile old_file = OldFile::kReplace) {
  std::vector<std::string> told;
  KlvSink sink(
      file.string(), old_file, [&](const std::string& message) { told.push_back(message); }, nullptr);
  for (int i = 0; i < frames; ++i) sink.on_frame(frame_at(i));
  sink.on_end();
  return told;
}

TEST(KlvTarget, IsAReceiverOrTheNameOfAFile) {
  EXPECT_EQ(parse_klv_target("run.ts"), std::nullopt);
  EXPECT_EQ(parse_klv_target(""), std::nullopt);
  const auto receiver = parse_klv_target("udp://[::1]:5004");
  ASSERT_TRUE(receiver);
  EXPECT_EQ(receiver->host, "::1");
  EXPECT_EQ(receiver->port, 5004);
  for (const char* bad :
       {"udp://", "udp://host", "udp://host:0", "udp://:5004", "tcp://host:5004", "rtp://host:1"})
    EXPECT_THROW(parse_klv_target(bad), std::invalid_argument) << bad;
}

TEST(KlvSink, WritesWholePacketsOfATransportStream) {
  const testing::TemporaryFolder folder;
  run_to(folder.path() / "run.ts", 30);
  const std::string stream = content_of(folder.path() / "run.ts");
  ASSERT_GT(stream.size(), 30 * kPacket);
  ASSERT_EQ(stream.size() % kPacket, 0U);
  for (std::size_t at = 0; at < stream.size(); at += kPacket) ASSERT_EQ(stream[at], 'G') << at;
}

TEST(KlvSink, WritesTheSameBytesOfTheSameRun) {
  const testing::TemporaryFolder folder;
  run_to(folder.path() / "a.ts", 20);
  run_to(folder.path() / "b.ts", 20);
  EXPECT_EQ(content_of(folder.path() / "a.ts"), content_of(folder.path() / "b.ts"));
}

TEST(KlvSink, LeavesNoFileOfARunThatDidNotBegin) {
  const testing::TemporaryFolder folder;
  run_to(folder.path() / "run.ts", 0);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(KlvSink, KeepsTheFileOfAnEarlierFlight) {
  const testing::TemporaryFolder folder;
  run_to(folder.path() / "run.ts", 5);
  const auto told = run_to(folder.path() / "run.ts", 5, OldFile::kKeep);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].find("run.old-1.ts"), std::string::npos) << told[0];
  EXPECT_TRUE(fs::exists(folder.path() / "run.old-1.ts"));
}

TEST(KlvSink, SaysWhatIsWrongWithItsDisk) {
  KlvSink sink(
      "/dev/full", OldFile::kReplace, [](const std::string&) {}, nullptr);
  try {
    for (int i = 0; i < 1000; ++i) sink.on_frame(frame_at(i));
    sink.on_end();
    ADD_FAILURE() << "a full disk went unnoticed";
  } catch (const std::exception& error) {
    EXPECT_EQ(std::string(error.what()), "--klv /dev/full: cannot be written: No space left on device");
  }
  sink.on_frame(frame_at(1001));  // is written nowhere, and says nothing
}

TEST(KlvSink, RefusesAHostThatDoesNotExist) {
  EXPECT_THROW(KlvSink(
                   "udp://no.such.host.invalid:5004", OldFile::kReplace, [](const std::string&) {}, nullptr),
               std::runtime_error);
}

}  // namespace
}  // namespace geoloc::io
