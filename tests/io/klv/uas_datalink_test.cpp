// SPDX-License-Identifier: Apache-2.0
// What others read in it is tested with their readers (tests/apps/klv_test.py).
#include "geoloc/io/klv/uas_datalink.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "geoloc/geometry/angles.hpp"
#include "io/klv/klv_reader.hpp"

namespace geoloc::io {
namespace {

using testing::KlvReader;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

OutputFrame seen(const ViewReport& view, HostTime captured_at = HostTime{std::chrono::seconds{1700000000}}) {
  OutputFrame frame;
  frame.captured_at = captured_at;
  frame.view = view;
  return frame;
}

/// One item of a view: its tag, where it stands, and how the standard maps it.
struct Item {
  int tag;
  std::function<void(ViewReport&, double)> set;
  double low, high;  // a signed item: low is -high
  std::size_t bytes;
};

std::vector<Item> items() {
  const auto centre = [](ViewReport& view) -> Geodetic& {
    if (!view.image_centre) view.image_centre = GroundPoint{};
    return view.image_centre->position;
  };
  const auto corner = [](ViewReport& view, std::size_t i) -> Geodetic& {
    if (!view.footprint) view.footprint.emplace();
    return (*view.footprint)[i].position;
  };
  std::vector<Item> all{
      {5, [](ViewReport& view, double x) { view.yaw_deg = x; }, 0, 360, 2},
      {6, [](ViewReport& view, double x) { view.pitch_deg = x; }, -20, 20, 2},
      {7, [](ViewReport& view, double x) { view.roll_deg = x; }, -50, 50, 2},
      {13, [](ViewReport& view, double x) { view.camera.latitude_deg = x; }, -90, 90, 4},
      {14, [](ViewReport& view, double x) { view.camera.longitude_deg = x; }, -180, 180, 4},
      {15, [](ViewReport& view, double x) { view.camera_height.msl_m = x; }, -900, 19000, 2},
      {16, [](ViewReport& view, double x) { view.sight.horizontal_view_deg = x; }, 0, 180, 2},
      {17, [](ViewReport& view, double x) { view.sight.vertical_view_deg = x; }, 0, 180, 2},
      {18, [](ViewReport& view, double x) { view.camera_in_vehicle.azimuth_deg = x; }, 0, 360, 4},
      {19, [](ViewReport& view, double x) { view.camera_in_vehicle.elevation_deg = x; }, -180, 180, 4},
      {20, [](ViewReport& view, double x) { view.camera_in_vehicle.roll_deg = x; }, 0, 360, 4},
      {21, [](ViewReport& view, double x) { view.sight.range_m = x; }, 0, 5e6, 4},
      {23, [=](ViewReport& view, double x) { centre(view).latitude_deg = x; }, -90, 90, 4},
      {24, [=](ViewReport& view, double x) { centre(view).longitude_deg = x; }, -180, 180, 4},
      {25, [=](ViewReport& view, double x) { centre(view), view.ground_height.msl_m = x; }, -900, 19000, 2},
      {75, [](ViewReport& view, double x) { view.camera_height.ellipsoid_m = x; }, -900, 19000, 2},
      {78, [=](ViewReport& view, double x) { centre(view), view.ground_height.ellipsoid_m = x; }, -900, 19000,
       2},
  };
  for (std::size_t i = 0; i < 4; ++i) {
    const int tag = 82 + 2 * static_cast<int>(i);
    all.push_back({tag, [=](ViewReport& view, double x) { corner(view, i).latitude_deg = x; }, -90, 90, 4});
    all.push_back(
        {tag + 1, [=](ViewReport& view, double x) { corner(view, i).longitude_deg = x; }, -180, 180, 4});
  }
  return all;
}

double value_of(const KlvReader& set, const Item& item) {
  return item.low == -item.high ? set.signed_value(item.tag, item.high)
                                : set.unsigned_value(item.tag, item.low, item.high);
}

TEST(UasDatalink, SaysEveryQuantityToHalfAStep) {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    ViewReport view;
    std::vector<double> values;
    for (const Item& item : items()) {
      // Now and then the ends of the range, but for circles, whose ends are one.
      const double share = round % 10 == 0 && item.high != 360
                               ? round / 10 % 2
                               : std::uniform_real_distribution<>(0.0, 1.0)(random);
      values.push_back(item.low + share * (item.high - item.low));
      item.set(view, values.back());
    }
    const std::string bytes = uas_datalink_set(seen(view));
    const KlvReader set(bytes);
    std::size_t i = 0;
    for (const Item& item : items()) {
      ASSERT_EQ(set.item(item.tag).size(), item.bytes) << item.tag;
      const double step = (item.high - item.low) / (std::ldexp(1.0, 8 * static_cast<int>(item.bytes)) - 2);
      EXPECT_NEAR(value_of(set, item), values[i++], 0.501 * step) << item.tag;
    }
    EXPECT_EQ(set.count(), items().size() + 3);  // time, version, checksum
  }
}

/// The examples that the standard gives with its items.
TEST(UasDatalink, SaysTheStandardsOwnExamplesAsItDoes) {
  const struct {
    int tag;
    double value;
    std::uint64_t bytes;
  } examples[] = {{5, 159.974365, 0x71c2},
                  {6, -0.431531724, 0xfd3d},
                  {7, 3.40586566, 0x08b8},
                  {13, 60.1768229669783, 0x5595b66d},
                  {14, 128.426759042045, 0x5b5360c4},
                  {15, 14190.7195, 0xc221},
                  {16, 144.571298, 0xcd9c},
                  {17, 152.643626, 0xd917},
                  {18, 160.719211474396, 0x724a0a20},
                  {19, -168.792324833941, 0x87f84b86},
                  {21, 68590.9832987494, 0x03830926},
                  {23, -10.5423886331461, 0xf101a229},
                  {24, 29.1578901229230, 0x14bc082b},
                  {25, 3216.03723, 0x34f3},
                  {75, 14190.7195, 0xc221},
                  {78, 9.44533455, 0x0bb3}};
  for (const auto& example : examples) {
    ViewReport view;
    for (const Item& item : items()) {
      if (item.tag == example.tag) item.set(view, example.value);
    }
    const std::string bytes = uas_datalink_set(seen(view));
    EXPECT_EQ(testing::big_endian_number(KlvReader(bytes).item(example.tag)), example.bytes) << example.tag;
  }
}

TEST(UasDatalink, IsOfItsTimeInMicrosecondsAndOfItsVersion) {
  const std::string bytes =
      uas_datalink_set(seen({}, HostTime{std::chrono::nanoseconds{1'795'000'000'123'456'789}}));
  EXPECT_EQ(testing::big_endian_number(KlvReader(bytes).item(2)), 1'795'000'000'123'456U);
  EXPECT_EQ(testing::big_endian_number(KlvReader(bytes).item(65)), 17U);
  EXPECT_EQ(bytes.substr(0, 16),
            std::string("\x06\x0e\x2b\x34\x02\x0b\x01\x01\x0e\x01\x03\x01\x01\x00\x00\x00", 16));
}

TEST(UasDatalink, OfAFrameThatWasNotLocatedHasItsTimeAlone) {
  OutputFrame frame = seen({});
  frame.view.reset();
  const std::string bytes = uas_datalink_set(frame);
  EXPECT_EQ(KlvReader(bytes).count(), 3U);
}

TEST(UasDatalink, LeavesOutWhatIsUnknownOrCannotBeSaid) {
  for (const Item& item : items()) {
    const bool is_circle = item.high == 360;
    const bool is_place = item.bytes == 4 && (item.high == 90 || (item.high == 180 && item.tag != 19));
    for (const double value :
         {kNone, std::numeric_limits<double>::infinity(), item.high + 1e-3 * item.high}) {
      if (std::isfinite(value) && (is_circle || is_place || item.tag == 6 || item.tag == 7)) continue;
      ViewReport view;
      item.set(view, value);
      const std::string bytes = uas_datalink_set(seen(view));
      EXPECT_FALSE(KlvReader(bytes).has(item.tag)) << item.tag << " " << value;
    }
  }
}

TEST(UasDatalink, CountsHeadingsAndRollsFromZeroTo360) {
  ViewReport view;
  view.yaw_deg = -90.0;
  view.camera_in_vehicle.roll_deg = -1.0;
  view.camera_in_vehicle.azimuth_deg = 359.5;
  view.camera = {47.0, 190.0};
  const std::string bytes = uas_datalink_set(seen(view));
  const KlvReader set(bytes);
  EXPECT_NEAR(set.unsigned_value(5, 0, 360), 270.0, 0.003);
  EXPECT_NEAR(set.unsigned_value(20, 0, 360), 359.0, 1e-6);
  EXPECT_NEAR(set.unsigned_value(18, 0, 360), 359.5, 1e-6);
  EXPECT_NEAR(set.signed_value(14, 180), -170.0, 1e-6);
}

TEST(UasDatalink, SaysSteepAttitudesInTheItemsOfFullRange) {
  ViewReport view;
  view.pitch_deg = -20.01;
  view.roll_deg = 50.01;
  const std::string steep = uas_datalink_set(seen(view));
  for (const int small : {6, 7}) EXPECT_FALSE(KlvReader(steep).has(small));
  EXPECT_NEAR(KlvReader(steep).signed_value(90, 90), -20.01, 1e-7);
  EXPECT_NEAR(KlvReader(steep).signed_value(91, 90), 50.01, 1e-7);
  view.roll_deg = -120.0;  // upside down: the standard's word for out of range
  const std::string inverted = uas_datalink_set(seen(view));
  EXPECT_EQ(testing::big_endian_number(KlvReader(inverted).item(91)), 0x80000000U);
}

}  // namespace
}  // namespace geoloc::io
