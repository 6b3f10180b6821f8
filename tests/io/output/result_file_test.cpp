// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/result_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <vector>

#include "support/temporary_folder.hpp"

namespace geoloc::io {
namespace {

std::string content(const std::filesystem::path& file) {
  std::ifstream input(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(input), std::istreambuf_iterator<char>()};
}

struct Told {
  TellUser tell() {
    return [this](const std::string& message) { messages.push_back(message); };
  }
  std::vector<std::string> messages;
};

TEST(ResultFile, OfAnEarlierRunIsKeptOnceAndSaid) {
  const testing::TemporaryFolder folder;
  const auto file = folder.write("a.b.json", "old");
  Told told;
  for (int run = 1; run <= 2; ++run) {
    ResultFile result(file, OldFile::kKeep, told.tell());
    result.write("new " + std::to_string(run));
    result.write("newer " + std::to_string(run));
    EXPECT_EQ(content(file), "newer " + std::to_string(run));
  }
  EXPECT_EQ(content(folder.path() / "a.b.old-1.json"), "old");
  EXPECT_EQ(content(folder.path() / "a.b.old-2.json"), "newer 1");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.b.old-3.json"));
  ASSERT_EQ(told.messages.size(), 2U);
  EXPECT_NE(told.messages[1].find("a.b.old-2.json"), std::string::npos);
}

TEST(ResultFile, OfAnotherRunThatGoesOnStaysWhereItIs) {
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "a.json";
  Told told;
  ResultFile first(file, OldFile::kKeep, told.tell()), second(file, OldFile::kKeep, told.tell());
  first.write("first");
  second.write("second");
  EXPECT_THROW(first.write("first again"), std::runtime_error);
  second.write("second again");
  EXPECT_EQ(content(file), "second again");
  EXPECT_EQ(content(folder.path() / "a.old-1.json"), "first");
}

TEST(ResultFile, IsReplacedWhereTheRunCanBeRepeated) {
  const testing::TemporaryFolder folder;
  const auto file = folder.write("a.json", "old");
  Told told;
  ResultFile(file, OldFile::kReplace, told.tell()).write("new");
  EXPECT_EQ(content(file), "new");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
  EXPECT_TRUE(told.messages.empty());
}

TEST(ResultFile, HasNothingToKeepOfAnEmptyFileOrADevice) {
  const testing::TemporaryFolder folder;
  Told told;
  ResultFile(folder.write("a.json", ""), OldFile::kKeep, told.tell()).write("new");
  ResultFile device("/dev/null", OldFile::kKeep, told.tell());
  device.write("new");
  device.write("newer");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  EXPECT_TRUE(told.messages.empty());
}

}  // namespace
}  // namespace geoloc::io
