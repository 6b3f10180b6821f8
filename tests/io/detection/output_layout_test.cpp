// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/detection/output_layout.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "io/detection/detection_fields.hpp"

namespace geoloc::io {
namespace {

using Shape = std::vector<std::int64_t>;

constexpr ImageSize kInput{640, 640};
constexpr std::int64_t kCells = 80 * 80 + 40 * 40 + 20 * 20;

OutputFacts facts(Shape shape, std::optional<int> classes, const std::string& task = "detect") {
  OutputFacts facts;
  facts.shape = std::move(shape);
  facts.classes = classes;
  facts.task = task;
  facts.input = kInput;
  return facts;
}

/// The names of the layouts that the output may have.
std::string layouts(const OutputFacts& facts, OutputLayout wanted = OutputLayout::kAuto) {
  std::string names;
  for (const OutputForm& form : possible_forms(facts, wanted))
    names += std::string{names.empty() ? "" : " "} + name_of(form.layout);
  return names;
}

TEST(OutputLayout, IsToldByMetadataAndShape) {
  EXPECT_EQ(layouts(facts({1, 84, kCells}, 80)), "yolo11");
  EXPECT_EQ(layouts(facts({1, 20, kCells}, 15, "obb")), "obb");
  EXPECT_EQ(layouts(facts({1, 56, kCells}, 1, "pose")), "pose");
  EXPECT_EQ(layouts(facts({1, 300, 57}, 1, "pose")), "end2end");
  EXPECT_EQ(layouts(facts({1, 3 * kCells, 85}, 80)), "yolov5");
  EXPECT_EQ(layouts(facts({1, 300, 84}, 80)), "rtdetr");
  EXPECT_EQ(layouts(facts({1, 300, 6}, 80)), "end2end");
  OutputFacts segment = facts({1, 116, kCells}, 80, "segment");
  EXPECT_EQ(layouts(segment), "") << "without its prototypes nobody knows how many numbers are the mask's";
  segment.mask_coefficients = 32;
  EXPECT_EQ(layouts(segment), "segment");
}

TEST(OutputLayout, IsToldByShapeWhereThereAreNoMetadata) {
  EXPECT_EQ(layouts(facts({1, 84, kCells}, {}, "")), "yolo11");
  EXPECT_EQ(layouts(facts({1, 3 * kCells, 85}, {}, "")), "yolov5");
  EXPECT_EQ(layouts(facts({1, 300, 6}, {}, "")), "end2end");
  EXPECT_EQ(layouts(facts({1, 300, 84}, {}, "")), "");
}

TEST(OutputLayout, OfNetworksThatChooseTheirBoxesIsToldWhateverTheirTask) {
  for (const auto& [task, values] :
       std::vector<std::pair<std::string, std::int64_t>>{{"detect", 6}, {"obb", 7}, {"pose", 6 + 51}}) {
    OutputFacts chosen = facts({1, 300, values}, 2, task);
    chosen.has_selected = true;
    EXPECT_EQ(layouts(chosen), "end2end") << task;
  }
  OutputFacts masks = facts({1, 300, 38}, 80, "segment");
  masks.has_selected = true;
  masks.mask_coefficients = 32;
  EXPECT_EQ(layouts(masks), "end2end");
}

TEST(OutputLayout, IsNotGuessedWhereTwoFit) {
  EXPECT_EQ(layouts(facts({1, 300, 6}, 2)), "end2end rtdetr");
  OutputFacts rtdetr = facts({1, 300, 6}, 2);
  rtdetr.is_rtdetr = true;
  EXPECT_EQ(layouts(rtdetr), "rtdetr rtdetr_top");
  rtdetr.classes = 80;
  EXPECT_EQ(layouts(rtdetr), "rtdetr_top");
}

TEST(OutputLayout, OfAListOfAllCellsIsNotGuessed) {
  for (const std::int64_t values : {6, 84, 85})
    EXPECT_EQ(layouts(facts({1, kCells, values}, 80)), "") << values;
  EXPECT_EQ(layouts(facts({1, kCells, 85}, 80), OutputLayout::kYolox), "yolox");
}

TEST(OutputLayout, ThatIsWantedNeedsNoMetadataButTheRightShape) {
  EXPECT_EQ(layouts(facts({1, 20, kCells}, {}, ""), OutputLayout::kObb), "obb");
  EXPECT_EQ(possible_forms(facts({1, 20, kCells}, {}, ""), OutputLayout::kObb).at(0).classes, 15);
  EXPECT_EQ(layouts(facts({1, 300, 6}, 2), OutputLayout::kRtdetr), "rtdetr");
  EXPECT_EQ(layouts(facts({1, 300, 6}, 3), OutputLayout::kRtdetr), "");
  EXPECT_EQ(layouts(facts({1, kCells - 1, 85}, 80), OutputLayout::kYolox), "");
}

TEST(OutputLayout, OfNamesThatAreMoreOrLessThanItsClassesIsNone) {
  for (const int classes : {1, 79, 81}) EXPECT_EQ(layouts(facts({1, 84, kCells}, classes)), "") << classes;
}

TEST(OutputLayout, OfHostileShapesIsNone) {
  constexpr std::int64_t kHuge = std::numeric_limits<std::int64_t>::max();
  for (const Shape& shape : {Shape{},
                             {1},
                             {1, 84},
                             {1, 84, kCells, 1},
                             {2, 84, kCells},
                             {1, 0, 0},
                             {1, -84, -7},
                             {1, kHuge, kHuge},
                             {1, 84, kHuge},
                             {1, 4, kCells},
                             {1, kCells, 4},
                             {kHuge, 1, 1}}) {
    for (const auto& [layout, name] : EnumNames<OutputLayout>::all)
      EXPECT_EQ(layouts(facts(shape, {}, ""), layout), "") << name << " of " << shape.size();
  }
  EXPECT_EQ(layouts(facts({1, 84, kCells}, -5)), "");
  EXPECT_EQ(layouts(facts({1, 84, kCells}, 80, "classify")), "");
}

}  // namespace
}  // namespace geoloc::io
