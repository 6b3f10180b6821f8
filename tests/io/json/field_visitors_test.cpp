// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "io/json/field_lister.hpp"
#include "io/json/field_reader.hpp"
#include "io/json/field_writer.hpp"

namespace geoloc::io {
namespace {

enum class Colour { kRed, kBlue };

struct Wheel {
  double radius_m = 0.3;
};

struct Car {
  int doors = 4;
  bool electric = false;
  std::string name = "beetle";
  Colour colour = Colour::kRed;
  std::array<double, 2> size_m{1.0, 2.0};
  Wheel wheel;
  std::vector<Wheel> spares;
};

template <class V>
void visit_fields(V& v, Wheel& wheel) {
  v.field("radius_m", wheel.radius_m, Range::above(0, 1), "m", "Unloaded radius");
}

template <class V>
void visit_fields(V& v, Car& car) {
  v.field("doors", car.doors, Range::closed(0, 5), "", "Count");
  v.field("electric", car.electric, Any{}, "", "Drive");
  v.field("name", car.name, Any{}, "", "Model");
  v.field("colour", car.colour, Any{}, "", "Paint");
  v.field("size_m", car.size_m, Range::positive(), "m", "Length and width");
  v.section("wheel", car.wheel);
  v.list("spares", car.spares, "In the boot");
  v.relation("doors", car.doors, car.doors != 1, "must not be 1");
}

std::vector<std::string> read(const char* text, Car& car) {
  std::vector<std::string> problems;
  const auto json = nlohmann::json::parse(text);
  FieldReader reader(json, "", problems);
  visit_fields(reader, car);
  reader.refuse_unknown();
  return problems;
}

}  // namespace
}  // namespace geoloc::io

namespace geoloc {

template <>
struct EnumNames<io::Colour> {
  static constexpr std::array<std::pair<io::Colour, const char*>, 2> all{
      {{io::Colour::kRed, "red"}, {io::Colour::kBlue, "blue"}}};
};

}  // namespace geoloc

namespace geoloc::io {
namespace {

TEST(Fields, WhatIsWrittenIsReadBack) {
  Car car;
  car.doors = 2;
  car.electric = true;
  car.colour = Colour::kBlue;
  car.wheel.radius_m = 0.1 + 0.2;  // every bit counts
  car.spares.resize(2);
  car.spares[1].radius_m = 0.7;
  Car back;
  EXPECT_TRUE(read(fields_to_json(car).dump().c_str(), back).empty());
  EXPECT_EQ(back.doors, 2);
  EXPECT_TRUE(back.electric);
  EXPECT_EQ(back.colour, Colour::kBlue);
  EXPECT_EQ(back.wheel.radius_m, car.wheel.radius_m);
  ASSERT_EQ(back.spares.size(), 2U);
  EXPECT_EQ(back.spares[0].radius_m, 0.3);
  EXPECT_EQ(back.spares[1].radius_m, 0.7);
}

TEST(Fields, EveryFaultIsToldAtOnceByItsPathWithTheValueMet) {
  Car car;
  const auto problems =
      read(R"({"doors": 4.5, "electric": 1, "name": 7, "colour": "green", "size_m": [1, "x"],
                                 "wheel": {"radius_m": null, "radios_m": 1}, "dors": 3, "spares": [{}, {"radius": 1}]})",
           car);
  ASSERT_EQ(problems.size(), 9U);
  const std::string all = ::testing::PrintToString(problems);
  for (const char* expected :
       {"doors must be a whole number, but is 4.5", "electric must be true or false, but is 1",
        "name must be a text, but is 7", "colour must be one of: red, blue, but is \\\"green\\\"",
        "size_m[1] must be a finite number, but is \\\"x\\\"",
        "wheel.radius_m must be a finite number, but is null",
        "spares[1].radius is not a setting; did you mean radius_m",
        "wheel.radios_m is not a setting; did you mean radius_m",
        "dors is not a setting; did you mean doors"}) {
    EXPECT_NE(all.find(expected), std::string::npos) << expected << " in " << all;
  }
}

TEST(Fields, WhatIsNoObjectIsAFault) {
  Car car;
  EXPECT_EQ(read("[1, 2]", car).size(), 1U);
  EXPECT_EQ(read(R"({"wheel": 3})", car).size(), 1U);
  EXPECT_EQ(read(R"({"size_m": [1, 2, 3]})", car).size(), 1U);
  EXPECT_EQ(read(R"({"spares": {}})", car), std::vector<std::string>{"spares must be a list, but is {}"});
  EXPECT_EQ(read(R"({"spares": [3]})", car),
            std::vector<std::string>{"spares[0] must be an object, but is 3"});
}

TEST(Fields, AHostileValueIsShownByItsBeginning) {
  Car car;
  const auto problems = read((R"({"doors": ")" + std::string(1'000'000, 'x') + R"("})").c_str(), car);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_LT(problems[0].size(), 120U);
}

TEST(Fields, AKeyThatIsIgnoredIsNoFault) {
  Wheel wheel;
  std::vector<std::string> problems;
  const auto json = nlohmann::json::parse(R"({"radius_m": 0.5, "video": 1, "vidio": 1})");
  FieldReader reader(json, "", problems);
  visit_fields(reader, wheel);
  reader.ignore("video");
  reader.refuse_unknown();
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].find("vidio is not a setting"), 0U);
}

TEST(Fields, TheReferenceListsPathDefaultRangeUnitAndMeaning) {
  std::vector<FieldLine> lines;
  FieldLister lister(lines);
  Car car;
  visit_fields(lister, car);
  ASSERT_EQ(lines.size(), 8U);
  EXPECT_EQ(lines[0].range, "[0, 5]");
  EXPECT_EQ(lines[0].unit, "");
  EXPECT_EQ(lines[1].range, "true, false");
  EXPECT_EQ(lines[2].range, "");
  EXPECT_EQ(lines[3].default_value, "\"red\"");
  EXPECT_EQ(lines[3].range, "red, blue");
  EXPECT_EQ(lines[5].path, "wheel.radius_m");
  EXPECT_EQ(lines[5].default_value, "0.3");
  EXPECT_EQ(lines[5].range, "(0, 1]");
  EXPECT_EQ(lines[5].unit, "m");
  EXPECT_EQ(lines[5].meaning, "Unloaded radius");
  EXPECT_EQ(lines[6].path, "spares");
  EXPECT_EQ(lines[6].default_value, "[]");
  EXPECT_EQ(lines[7].path, "spares[].radius_m");
}

}  // namespace
}  // namespace geoloc::io
