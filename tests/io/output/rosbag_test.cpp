// SPDX-License-Identifier: Apache-2.0
// What others read in bags is tested with their readers (tests/apps/rosbag_test.py).
#include "geoloc/io/output/rosbag.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

#include "io/output/cdr.hpp"

namespace geoloc::io {
namespace {

using namespace std::string_view_literals;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();  // no figure
constexpr std::string_view kMagic = "\x89MCAP0\r\n"sv;

TEST(Cdr, HasTheBytesOfItsSpecification) {
  EXPECT_EQ(CdrMessage().add(std::int32_t{258}).bytes(), "\0\1\0\0\2\1\0\0"sv);
  EXPECT_EQ(CdrMessage().add(1.0).bytes(), "\0\1\0\0\0\0\0\0\0\0\xF0\x3F"sv);
  EXPECT_EQ(CdrMessage().add(-2.0f).bytes(), "\0\1\0\0\0\0\0\xC0"sv);
  EXPECT_EQ(CdrMessage().add_text("ab").bytes(), "\0\1\0\0\3\0\0\0ab\0"sv);
  EXPECT_EQ(CdrMessage().add(true).add(std::int8_t{-1}).bytes(), "\0\1\0\0\1\xFF"sv);
}

TEST(Cdr, PutsNumbersAtMultiplesOfTheirSize) {
  constexpr std::size_t kHead = 4;
  for (std::size_t texts = 0; texts < 9; ++texts) {
    CdrMessage message;
    message.add_text(std::string(texts, 'x'));
    EXPECT_EQ((CdrMessage(message).add(1.0).bytes().size() - kHead) % 8, 0u);
    EXPECT_EQ((CdrMessage(message).add(std::int32_t{1}).bytes().size() - kHead) % 4, 0u);
    EXPECT_EQ((CdrMessage(message).add(std::uint16_t{1}).bytes().size() - kHead) % 2, 0u);
    EXPECT_EQ(CdrMessage(message).add(std::uint8_t{1}).bytes().size(), message.bytes().size() + 1);
  }
}

RunRecord run_with(const std::string& name, double latitude_deg, double above_home_m) {
  ObjectReport object;
  object.id = std::numeric_limits<std::uint64_t>::max();
  object.class_name = name;
  object.position = {latitude_deg, 8.5};
  object.ellipse = {kNone, kNone, kNone};
  object.covariance_in_enu.setConstant(kNone);
  object.height.above_home_m = above_home_m;
  RunRecord run;
  run.objects = {object};
  run.local_frame.emplace(Geodetic{47.4, 8.5});
  run.trajectory = {{HostTime{}, {kNone, 0.0, 20.0}}};
  run.raw_fixes = {{HostTime{}, {}, {kNone, 0.0}, 20.0}};
  return run;
}

TEST(Rosbag, IsWholeWhateverTheNamesAndFiguresAre) {
  for (const std::string& name : {std::string("\0\x1B\xFF", 3), std::string(100'000, '<'), std::string()}) {
    const std::string bag = run_to_rosbag(run_with(name, 47.4, kNone));
    EXPECT_EQ(bag.substr(0, kMagic.size()), kMagic);
    EXPECT_EQ(bag.substr(bag.size() - kMagic.size()), kMagic);
    EXPECT_NE(bag.find("object 18446744073709551615"), std::string::npos);
    EXPECT_EQ(bag, run_to_rosbag(run_with(name, 47.4, kNone)));
  }
}

TEST(Rosbag, HasNoObjectWithoutAPlace) {
  EXPECT_EQ(run_to_rosbag(run_with("car", kNone, 0.0)).find("object 1"), std::string::npos);
  EXPECT_EQ(run_to_rosbag(RunRecord{}).find("object "), std::string::npos);
}

}  // namespace
}  // namespace geoloc::io
