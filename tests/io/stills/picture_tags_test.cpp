// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/stills/picture_tags.hpp"
#include "support/source_tree.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace geoloc::io {
namespace {

std::string packet(const std::string& description) {
  return R"(<x:xmpmeta xmlns:x="adobe:ns:meta/"><rdf:RDF>)" + description + "</rdf:RDF></x:xmpmeta>";
}

TEST(Xmp, PropertiesAreAttributesAndElementsAlike) {
  const auto properties = parse_xmp(packet(
      R"(<rdf:Description rdf:about="" a:one="1"><a:two>2</a:two></rdf:Description><rdf:Description b:three="3"/>)"));
  EXPECT_EQ(properties.at("a:one"), "1");
  EXPECT_EQ(properties.at("a:two"), "2");
  EXPECT_EQ(properties.at("b:three"), "3");
  EXPECT_EQ(properties.count("rdf:about"), 0U);
}

TEST(Xmp, PropertiesOfAStructureHaveItsName) {
  const auto properties = parse_xmp(packet(
      R"(<rdf:Description><s:Pose rdf:parseType="Resource"><s:Yaw>1</s:Yaw></s:Pose><s:Other s:Yaw="2"/>)"
      R"(<s:Nested><rdf:Description s:Yaw="3"/></s:Nested></rdf:Description>)"));
  EXPECT_EQ(properties.at("s:Pose/Yaw"), "1");
  EXPECT_EQ(properties.at("s:Other/Yaw"), "2");
  EXPECT_EQ(properties.at("s:Nested/Yaw"), "3");
}

TEST(Xmp, OfAMegabyteOrOfNoXMLIsRefused) {
  const std::string megabyte = packet("<rdf:Description a:b=\"" + std::string(1 << 20, 'x') + "\"/>");
  EXPECT_THROW(parse_xmp(megabyte), std::runtime_error);
  EXPECT_THROW(parse_xmp("<rdf:RDF"), std::runtime_error);
  EXPECT_TRUE(parse_xmp(packet("")).empty());
}

TEST(Xmp, NestedAsDeepAsThereIsRoomEndsNothing) {
  std::string deep;
  for (int i = 0; i < 20000; ++i) deep += "<a>";
  EXPECT_NO_FATAL_FAILURE(try { parse_xmp(packet(deep)); } catch (const std::runtime_error&){});
}

TEST(PictureTags, AreThoseThatWereWritten) {
  std::ifstream file(test_data() / "stills" / "dji.jpg", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const PictureTags tags = parse_picture_tags(bytes);
  EXPECT_EQ(tags.width_px, 64);
  EXPECT_EQ(tags.height_px, 48);
  EXPECT_EQ(tags.exif_text("GPSLatitudeRef"), "N");
  EXPECT_EQ(tags.exif_text("SubSecTimeOriginal"), "125");
  EXPECT_EQ(tags.xmp_text("drone-dji:GimbalPitchDegree"), "-60.5");
  EXPECT_FALSE(tags.xmp_text("drone-dji:NoSuchTag"));
}

TEST(PictureTags, OfWhatIsNoPictureAreRefused) {
  EXPECT_THROW(parse_picture_tags(""), std::runtime_error);
  EXPECT_THROW(parse_picture_tags("\x89PNG\r\n"), std::runtime_error);
  EXPECT_THROW(parse_picture_tags("\xFF\xD8\xFF\xE1"), std::runtime_error);
}

}  // namespace
}  // namespace geoloc::io
