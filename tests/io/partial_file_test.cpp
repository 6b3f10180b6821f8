// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/partial_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "support/temporary_folder.hpp"

namespace geoloc::io {
namespace {

std::size_t entries(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

TEST(PartialFile, TakesItsPlaceWhenItIsCommitted) {
  const testing::TemporaryFolder folder;
  const auto file = folder.write("a.json", "old");
  {
    PartialFile partial(file);
    std::ofstream(partial.name()) << "longer";
    EXPECT_EQ(std::filesystem::file_size(file), 3U);
    partial.commit();
    EXPECT_EQ(std::filesystem::file_size(file), 6U);
  }
  EXPECT_EQ(entries(folder.path()), 1U);
}

TEST(PartialFile, ThatIsNotCommittedLeavesThingsAsTheyWere) {
  const testing::TemporaryFolder folder;
  const auto file = folder.write("a.json", "old");
  {
    const PartialFile partial(file);
    std::ofstream(partial.name()) << "longer";
    EXPECT_EQ(entries(folder.path()), 2U);
  }
  EXPECT_EQ(std::filesystem::file_size(file), 3U);
  EXPECT_EQ(entries(folder.path()), 1U);
}

TEST(PartialFile, ThatCannotTakeItsPlaceSaysWhy) {
  const testing::TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "a.json");
  {
    PartialFile partial(folder.path() / "a.json");
    std::ofstream(partial.name()) << "text";
    try {
      partial.commit();
      ADD_FAILURE() << "it took a folder's place";
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(error.what(), (folder.path() / "a.json").string() + ": cannot be written: Is a directory");
    }
  }
  EXPECT_EQ(entries(folder.path()), 1U);
}

}  // namespace
}  // namespace geoloc::io
