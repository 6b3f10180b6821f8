// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/detection/onnx_metadata.hpp"
#include "support/source_tree.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <random>

// The files of tests/data/onnx come from tools/fixtures/make_onnx_fixtures.py.
namespace geoloc::io {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes read(const std::string& name) {
  std::ifstream stream{test_data() / "onnx" / name, std::ios::binary};
  return {std::istreambuf_iterator<char>{stream}, {}};
}

std::optional<OnnxMetadata> metadata_of(const Bytes& bytes) {
  return read_onnx_metadata(bytes.data(), bytes.size());
}

TEST(OnnxMetadata, IsWhatTheOnnxPackageWrote) {
  const auto metadata = metadata_of(read("plain.onnx"));
  ASSERT_TRUE(metadata);
  EXPECT_EQ(metadata->opset, 12);  // the file also names opset 3 of another domain
  ASSERT_EQ(metadata->inputs.size(), 1U);
  EXPECT_EQ(metadata->inputs[0].name, "images");
  EXPECT_EQ(metadata->inputs[0].shape, (std::vector<std::int64_t>{1, 3, 64, 96}));
  ASSERT_EQ(metadata->outputs.size(), 1U);
  EXPECT_EQ(metadata->outputs[0].name, "output0");
  EXPECT_EQ(metadata->outputs[0].shape, (std::vector<std::int64_t>{1, 6, 96}));
  EXPECT_EQ(metadata->properties.at("stride"), "8");
  EXPECT_EQ(parse_class_names(metadata->properties.at("names")),
            (std::vector<std::string>{"red", "driver's blue"}));
  EXPECT_FALSE(metadata->has_split_by_input);
}

TEST(OnnxMetadata, TellsLengthsThatAreNotFixed) {
  EXPECT_EQ(metadata_of(read("dynamic_size.onnx"))->inputs[0].shape,
            (std::vector<std::int64_t>{1, 3, kUnknownLength, kUnknownLength}));
}

TEST(OnnxMetadata, LeavesOutInputsThatAreConstants) {
  const auto metadata = metadata_of(read("constants_as_inputs.onnx"));
  ASSERT_EQ(metadata->inputs.size(), 1U);
  EXPECT_EQ(metadata->inputs[0].name, "images");
}

TEST(OnnxMetadata, KnowsSplitsInTheirNewForm) {
  EXPECT_TRUE(metadata_of(read("exported_opset17.onnx"))->has_split_by_input);
  EXPECT_FALSE(metadata_of(read("exported_opset12.onnx"))->has_split_by_input);
}

TEST(OnnxMetadata, RefusesWhatIsCutShortAnywhere) {
  const Bytes whole = read("plain.onnx");
  ASSERT_FALSE(whole.empty());
  std::size_t accepted = 0;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    accepted += metadata_of({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)}) ? 1U : 0U;
  }
  EXPECT_LE(accepted, 10U);  // a cut between two top-level fields behind the graph leaves a good message
}

TEST(OnnxMetadata, TakesAnyBytes) {
  const Bytes whole = read("exported_opset17.onnx");
  std::mt19937 random{4};
  for (int i = 0; i < 3000; ++i) {
    Bytes bytes = whole;
    for (int hits = 0; hits < 5; ++hits) bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    (void)metadata_of(bytes);
  }
  EXPECT_FALSE(metadata_of({}));
  EXPECT_FALSE(
      metadata_of({0x3a, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x01}));  // an endless graph
  EXPECT_FALSE(metadata_of(Bytes(1000, 0xff)));
}

TEST(ClassNames, AreReadFromAPythonDictionary) {
  EXPECT_EQ(parse_class_names("{0: 'person'}"), std::vector<std::string>{"person"});
  EXPECT_EQ(parse_class_names(R"({1: "driver's seat", 0: 'a "b"', 2: 'it\'s'})"),
            (std::vector<std::string>{"a \"b\"", "driver's seat", "it's"}));
  EXPECT_EQ(parse_class_names(" { 0 : 'é' , 1 : '' } "), (std::vector<std::string>{"é", ""}));
}

TEST(ClassNames, AreNotGuessed) {
  for (const char* text :
       {"", "{", "{}", "{0: 'a'", "{0: 'a}", "{0: a}", "{1: 'a'}", "{0: 'a', 2: 'b'}", "{0: 'a', 0: 'b'}",
        "{-1: 'a'}", "{0: 'a'} x", "['a']", "{99999999999999999999: 'a'}", "{0: 'a\\"}) {
    EXPECT_FALSE(parse_class_names(text)) << text;
  }
}

TEST(CentreSigma, IsTwoNumbersAndNothingElse) {
  const auto sigma = parse_centre_sigma("0.31,0.0080");
  ASSERT_TRUE(sigma);
  EXPECT_EQ(sigma->constant_px, 0.31);
  EXPECT_EQ(sigma->of_size, 0.008);
  EXPECT_TRUE(parse_centre_sigma("1e-3,0"));
  for (const char* text :
       {"", ",", "0.3", "0.3,", ",0.1", "0.3;0.1", "0,0.1", "-0.3,0.1", "0.3,-0.1", "nan,0.1", "0.3,inf",
        "0.3,0.1,0.1", " 0.3,0.1", "0.3,0.1 ", "0.3,0.1px", "1e999,0"}) {
    EXPECT_FALSE(parse_centre_sigma(text)) << text;
  }
}

}  // namespace
}  // namespace geoloc::io
