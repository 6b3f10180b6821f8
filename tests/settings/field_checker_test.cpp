// SPDX-License-Identifier: Apache-2.0
#include "settings/field_checker.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace geoloc {
namespace {

enum class Colour { kRed, kBlue };

struct Wheel {
  double radius_m = 0.3;
  double hub_m = 0.1;
};

struct Car {
  int doors = 4;
  Colour colour = Colour::kRed;
  std::string plate = "A1";
  std::map<std::string, std::string> stickers;
  std::array<double, 2> size_m{1.0, 2.0};
  std::vector<int> gears{1, 2};
  Wheel wheel;
  std::vector<Wheel> spares;
};

bool is_plate(const std::string& text) {
  return !text.empty() && text.front() == 'A';
}

template <class V>
void visit_fields(V& v, Wheel& wheel) {
  v.field("radius_m", wheel.radius_m, Range::above(0, 1), "m", "Unloaded");
  v.relation("radius_m", wheel.radius_m, wheel.radius_m > wheel.hub_m, "must be larger than hub_m");
}

template <class V>
void visit_fields(V& v, Car& car) {
  v.field("doors", car.doors, Range::closed(0, 5), "", "Count");
  v.field("colour", car.colour, Any{}, "", "Paint");
  v.field("plate", car.plate, Form{&is_plate, "a plate, such as A1"}, "", "Licence");
  v.field("stickers", car.stickers, Form{&is_plate, "a plate, such as A1"}, "", "By place");
  v.field("size_m", car.size_m, Range::finite(), "m", "Length and width");
  v.field("gears", car.gears, ListRange{Range::at_least(0), 3}, "", "Ids");
  v.section("wheel", car.wheel);
  v.list("spares", car.spares, "In the boot");
}

}  // namespace

template <>
struct EnumNames<Colour> {
  static constexpr std::array<std::pair<Colour, const char*>, 2> all{
      {{Colour::kRed, "red"}, {Colour::kBlue, "blue"}}};
};

namespace {

using Faults = std::vector<std::string>;

TEST(FieldChecker, FindsNothingWrongWithWhatIsAllowed) {
  Car car;
  car.spares.resize(2);
  EXPECT_EQ(check_fields(car), Faults{});
}

TEST(FieldChecker, NamesPathDemandAndTheValueMet) {
  Car car;
  car.doors = 6;
  car.size_m[1] = std::nan("");
  car.wheel.radius_m = -0.5;
  EXPECT_EQ(check_fields(car),
            (Faults{"doors must lie in [0, 5], but is 6", "size_m[1] must lie in (-inf, inf), but is nan",
                    "wheel.radius_m must lie in (0, 1], but is -0.5",
                    "wheel.radius_m must be larger than hub_m, but is -0.5"}));
}

TEST(FieldChecker, LooksIntoListsAndTexts) {
  Car car;
  car.colour = static_cast<Colour>(7);
  car.plate = "B" + std::string(100, 'x');
  car.stickers = {{"left", "A2"}, {"right", ""}};
  car.gears = {1, -2, 3, 4};
  car.spares.resize(2);
  car.spares[1].radius_m = 2.0;
  EXPECT_EQ(
      check_fields(car),
      (Faults{"colour must be one of: red, blue, but is 7",
              "plate must be a plate, such as A1, but is \"B" + std::string(59, 'x') + "…\"",
              "stickers.right must be a plate, such as A1, but is \"\"",
              "gears must hold at most 3 numbers, but holds 4", "gears[1] must lie in [0, inf), but is -2",
              "spares[1].radius_m must lie in (0, 1], but is 2"}));
}

}  // namespace
}  // namespace geoloc
