// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/text.hpp"

#include <gtest/gtest.h>

namespace geoloc::io {
namespace {

TEST(CleanText, LeavesGoodTextAlone) {
  for (const char* text :
       {"", "target", "\xC3\xA9t\xC3\xA9", "\xE4\xBD\xA0\xE5\xA5\xBD", "\xF0\x9F\x9A\x81", "a <b> & \"c\""}) {
    EXPECT_EQ(clean_text(text), text);
  }
}

TEST(CleanText, ReplacesWhatIsNoUtf8) {
  const std::string replacement = "\xEF\xBF\xBD";
  EXPECT_EQ(clean_text("a\xFFz"), "a" + replacement + "z");
  EXPECT_EQ(clean_text("\xC3"), replacement);                                      // cut short
  EXPECT_EQ(clean_text("\xC0\x80"), replacement + replacement);                    // overlong
  EXPECT_EQ(clean_text("\xED\xA0\x80"), replacement + replacement + replacement);  // a surrogate
  EXPECT_EQ(clean_text("\xF4\x90\x80\x80"),
            replacement + replacement + replacement + replacement);  // too high
}

TEST(CleanText, LeavesOutControlCharactersOfEveryKind) {
  const std::string controls("\x00\x1B[2J\r\n\x7F\xC2\x9B\xEF\xBF\xBE", 13);
  EXPECT_EQ(clean_text(controls), "[2J");
}

TEST(CleanText, CutsBetweenCharactersAndSaysSo) {
  EXPECT_EQ(clean_text("\xC3\xA9\xC3\xA9", 2), "\xC3\xA9\xC3\xA9");
  EXPECT_EQ(clean_text("\xC3\xA9\xC3\xA9\xC3\xA9", 2), "\xC3\xA9\xE2\x80\xA6");
  EXPECT_EQ(clean_text(std::string(100'000, 'x'), 10).size(), 9U + 3U);
}

TEST(AsciiText, IsPrintableAndBounded) {
  EXPECT_EQ(ascii_text("t\xC3\xA9\x01\xFF", 50), "t???");
  EXPECT_EQ(ascii_text("abcdef", 3), "abc");
}

}  // namespace
}  // namespace geoloc::io
