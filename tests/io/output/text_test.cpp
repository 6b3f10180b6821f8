// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/text.hpp"

#include <gtest/gtest.h>

#include <random>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

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

TEST(AnyBytes, StayInTheirField) {
  std::mt19937 generator(3);
  const std::string likely = "\xC3\xA9\xE2\x98\x83\xF0\x9F\xED\xA0<>&\"',=\n\x1B\x7Fz";
  std::uniform_int_distribution<std::size_t> pick(0, likely.size() - 1);
  for (int i = 0; i < 2000; ++i) {
    std::string name;
    for (int length = i % 40; length > 0; --length) name += likely[pick(generator)];
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(name.data()), name.size());
  }
}

}  // namespace
}  // namespace geoloc::io
