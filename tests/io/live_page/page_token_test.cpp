// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/live_page/page_token.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <stdexcept>

#include "support/temporary_folder.hpp"

namespace geoloc::io {
namespace {

namespace fs = std::filesystem;

class TokenFile : public ::testing::Test {
 protected:
  fs::path put(const std::string& text, fs::perms rights = fs::perms::owner_read) const {
    const fs::path file = folder.write("token", text);
    fs::permissions(file, rights);
    return file;
  }

  static std::string refusal(const fs::path& file) {
    try {
      read_or_make_page_token(file);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  geoloc::testing::TemporaryFolder folder;
};

TEST_F(TokenFile, IsMadeForItsOwnerAloneAndIsTheSameFromThenOn) {
  const fs::path file = folder.path() / "page.token";
  const std::string token = read_or_make_page_token(file);
  EXPECT_TRUE(is_page_token(token));
  EXPECT_EQ(token.size(), 32U);
  struct stat found {};
  ASSERT_EQ(stat(file.c_str(), &found), 0);
  EXPECT_EQ(found.st_mode & 07777U, 0600U);
  EXPECT_EQ(read_or_make_page_token(file), token);
  EXPECT_NE(read_or_make_page_token(folder.path() / "other.token"), token);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 2);  // no drafts
}

TEST_F(TokenFile, HoldsOneLine) {
  for (const char* const end : {"", "\n", "\r\n", " \n\n"}) {
    fs::remove(folder.path() / "token");
    EXPECT_EQ(read_or_make_page_token(put("aB3-._~aB3-._~aB3" + std::string(end))), "aB3-._~aB3-._~aB3");
  }
}

TEST_F(TokenFile, ThatOthersCanReadIsRefused) {
  const fs::path file = put("0123456789abcdef\n", fs::perms::owner_read | fs::perms::others_read);
  EXPECT_NE(refusal(file).find("chmod 600 " + file.string()), std::string::npos) << refusal(file);
  fs::permissions(file, fs::perms::owner_read | fs::perms::group_read);  // as systemd gives credentials
  EXPECT_EQ(refusal(file), "");
}

TEST_F(TokenFile, WithoutATokenIsRefused) {
  for (const std::string& text :
       {std::string(), std::string("\n"), std::string("0123456789abcde"), std::string("two words of a text"),
        std::string("0123456789\n0123456789"), std::string("0123456789abcdef;"), std::string(257, 'a'),
        std::string("0123456789abcde\xc3\xa4")}) {
    fs::remove(folder.path() / "token");
    EXPECT_NE(refusal(put(text)).find("holds no token"), std::string::npos) << text;
  }
  EXPECT_TRUE(is_page_token(std::string(256, 'a')));
}

TEST_F(TokenFile, ThatCannotBeIsNamed) {
  EXPECT_NE(refusal(folder.path() / "nowhere" / "token").find("nowhere/token: cannot be written"),
            std::string::npos);
  EXPECT_NE(refusal(folder.path()).find(folder.path().string()), std::string::npos);
}

}  // namespace
}  // namespace geoloc::io
