// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/json/fields.hpp"

#include <gtest/gtest.h>

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
};

template <class V>
void visit_fields(V& v, Wheel& wheel) {
  v.field("radius_m", wheel.radius_m, "m");
}

template <class V>
void visit_fields(V& v, Car& car) {
  v.field("doors", car.doors, "count");
  v.field("electric", car.electric, "drive");
  v.field("name", car.name, "model");
  v.field("colour", car.colour, "paint");
  v.field("size_m", car.size_m, "m");
  v.section("wheel", car.wheel);
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

template <>
struct EnumNames<Colour> {
  static constexpr std::array<std::pair<Colour, const char*>, 2> all{
      {{Colour::kRed, "red"}, {Colour::kBlue, "blue"}}};
};

namespace {

TEST(Fields, WhatIsWrittenIsReadBack) {
  Car car;
  car.doors = 2;
  car.electric = true;
  car.colour = Colour::kBlue;
  car.wheel.radius_m = 0.1 + 0.2;  // every bit counts
  FieldWriter writer;
  visit_fields(writer, car);
  Car back;
  EXPECT_TRUE(read(writer.take().dump().c_str(), back).empty());
  EXPECT_EQ(back.doors, 2);
  EXPECT_TRUE(back.electric);
  EXPECT_EQ(back.colour, Colour::kBlue);
  EXPECT_EQ(back.wheel.radius_m, car.wheel.radius_m);
}

TEST(Fields, EveryFaultIsToldAtOnceByItsPath) {
  Car car;
  const auto problems =
      read(R"({"doors": 4.5, "electric": 1, "name": 7, "colour": "green", "size_m": [1, "x"],
                                 "wheel": {"radius_m": null, "radios_m": 1}, "dors": 3})",
           car);
  ASSERT_EQ(problems.size(), 8U);
  const std::string all = ::testing::PrintToString(problems);
  for (const char* expected :
       {"doors must be a whole number", "electric must be true or false", "name must be a text",
        "colour must be one of: red, blue", "size_m[1] must be a finite number",
        "wheel.radius_m must be a finite number", "wheel.radios_m is not a setting; did you mean radius_m",
        "dors is not a setting; did you mean doors"}) {
    EXPECT_NE(all.find(expected), std::string::npos) << expected << " in " << all;
  }
}

TEST(Fields, WhatIsNoObjectIsAFault) {
  Car car;
  EXPECT_EQ(read("[1, 2]", car).size(), 1U);
  EXPECT_EQ(read(R"({"wheel": 3})", car).size(), 1U);
  EXPECT_EQ(read(R"({"size_m": [1, 2, 3]})", car).size(), 1U);
}

TEST(Fields, TheReferenceListsPathDefaultAndMeaning) {
  std::vector<FieldLine> lines;
  FieldLister lister(lines);
  Car car;
  visit_fields(lister, car);
  ASSERT_EQ(lines.size(), 6U);
  EXPECT_EQ(lines[3].default_value, "\"red\"");
  EXPECT_EQ(lines[5].path, "wheel.radius_m");
  EXPECT_EQ(lines[5].meaning, "m");
}

}  // namespace
}  // namespace geoloc::io
