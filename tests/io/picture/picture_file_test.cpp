// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/picture/picture_file.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/source_tree.hpp"
#include "support/temporary_folder.hpp"

namespace geoloc::io {
namespace {

std::string text_of(const std::vector<unsigned char>& bytes) {
  return {bytes.begin(), bytes.end()};
}

std::string encoded(const char* ending, const cv::Mat& picture) {
  std::vector<unsigned char> bytes;
  cv::imencode(ending, picture, bytes);
  return text_of(bytes);
}

std::string fixture() {
  std::ifstream stream{test_data() / "detection/targets.jpg", std::ios::binary};
  return {std::istreambuf_iterator<char>{stream}, {}};
}

/// A picture with odd sides and a different colour in every corner.
cv::Mat colours() {
  cv::Mat picture(37, 53, CV_8UC3);
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x)
      picture.at<cv::Vec3b>(y, x) =
          cv::Vec3b(static_cast<unsigned char>(4 * x), static_cast<unsigned char>(6 * y), 77);
  }
  return picture;
}

class PictureFile : public ::testing::Test {
 protected:
  cv::Mat read(const std::string& content) const { return read_picture(folder_.write("picture", content)); }

  std::string fault_of(const std::string& content) const {
    const auto file = folder_.write("picture", content);
    try {
      read_picture(file);
      return "none";
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()).rfind(file.string() + ": ", 0), 0U) << error.what();
      return error.what();
    }
  }

  const testing::TemporaryFolder folder_;
};

TEST_F(PictureFile, IsReadAsItWasWritten) {
  const cv::Mat picture = colours();
  for (const char* ending : {".png", ".bmp", ".tiff"})
    EXPECT_EQ(cv::norm(read(encoded(ending, picture)), picture, cv::NORM_INF), 0.0) << ending;
  const cv::Mat jpeg = read(encoded(".jpg", picture));
  EXPECT_EQ(jpeg.size(), picture.size());
}

TEST_F(PictureFile, OfWebpIsRead) {
  std::vector<unsigned char> bytes;
  constexpr int kLossless = 101;
  ASSERT_TRUE(cv::imencode(".webp", colours(), bytes, {cv::IMWRITE_WEBP_QUALITY, kLossless}));
  EXPECT_EQ(cv::norm(read(text_of(bytes)), colours(), cv::NORM_INF), 0.0);
}

TEST_F(PictureFile, OfGreyOrSixteenBitsOrWithTransparencyBecomesBgrOfEightBits) {
  const cv::Mat picture = colours();
  cv::Mat grey, grey_as_bgr, sixteen, transparent;
  cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
  cv::cvtColor(grey, grey_as_bgr, cv::COLOR_GRAY2BGR);
  picture.convertTo(sixteen, CV_16U, 257.0);
  cv::cvtColor(picture, transparent, cv::COLOR_BGR2BGRA);
  EXPECT_EQ(cv::norm(read(encoded(".png", grey)), grey_as_bgr, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(read(encoded(".png", transparent)), picture, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(read(encoded(".png", sixteen)), picture, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(read(encoded(".tiff", sixteen)), picture, cv::NORM_INF), 0.0);
}

TEST_F(PictureFile, OfFloatsIsRefused) {
  EXPECT_NE(fault_of(encoded(".tiff", cv::Mat(8, 8, CV_32FC3, cv::Scalar::all(0.5)))).find("integers"),
            std::string::npos);
}

TEST_F(PictureFile, CutShortIsRefusedWhereverItIsCut) {
  const std::string jpeg = fixture(), png = encoded(".png", colours());
  EXPECT_EQ(read(jpeg).size(), cv::Size(1280, 720));
  for (std::size_t size = 1; size < jpeg.size(); size += 3989)
    EXPECT_NE(fault_of(jpeg.substr(0, size)), "none") << size;
  for (std::size_t size = 1; size + 12 < png.size(); size += 101)
    EXPECT_NE(fault_of(png.substr(0, size)), "none") << size;
  EXPECT_NE(fault_of(jpeg.substr(0, jpeg.size() - 2)).find("cut short"), std::string::npos);
}

TEST_F(PictureFile, WithMoreBehindItsEndIsRead) {
  EXPECT_EQ(read(fixture() + "appended by a camera").size(), cv::Size(1280, 720));
}

TEST_F(PictureFile, ThatIsNoneIsRefused) {
  EXPECT_NE(fault_of("").find("is empty"), std::string::npos);
  EXPECT_NE(fault_of("no picture").find("no picture"), std::string::npos);
  EXPECT_NE(fault_of(std::string(5000, '\0')), "none");
  EXPECT_THROW(read_picture(folder_.path() / "none"), std::runtime_error);
  EXPECT_THROW(read_picture(folder_.path()), std::runtime_error);
}

TEST_F(PictureFile, ThatClaimsAnAbsurdSizeIsRefused) {
  std::string png = encoded(".png", colours());
  for (const std::size_t length : {16U, 20U}) png.replace(length, 4, "\x7F\xFF\xFF\xFF", 4);
  EXPECT_NE(fault_of(png), "none");
  std::string bmp = encoded(".bmp", colours());
  bmp.replace(18, 8, "\xFF\xFF\xFF\x7F\xFF\xFF\xFF\x7F", 8);
  EXPECT_NE(fault_of(bmp), "none");
}

TEST_F(PictureFile, OfTooManyPixelsIsRefusedBeforeMemoryIsTaken) {
  const auto number = [](std::uint32_t value) {
    std::string bytes;
    for (int byte = 0; byte < 4; ++byte, value >>= 8U) bytes += static_cast<char>(value);
    return bytes;
  };
  std::string bmp = encoded(".bmp", colours());
  bmp.replace(18, 8, number(32'000) + number(32'000));
  EXPECT_NE(fault_of(bmp).find("has 32000 x 32000 pixels; pictures of more than 200 million are not read"),
            std::string::npos)
      << fault_of(bmp);
  bmp.replace(18, 8, number(20'000) + number(10'000));  // not too many, but there is no data for them
  EXPECT_EQ(fault_of(bmp).find("million"), std::string::npos) << fault_of(bmp);
}

TEST_F(PictureFile, DamagedAnywhereIsReadOrRefused) {
  std::mt19937 random{5};
  for (const std::string& whole :
       {encoded(".jpg", colours()), encoded(".png", colours()), encoded(".tiff", colours())}) {
    for (int i = 0; i < 200; ++i) {
      std::string damaged = whole;
      for (int changes = 0; changes < 3; ++changes)
        damaged[random() % damaged.size()] = static_cast<char>(random());
      is_whole_jpeg(damaged);
      fault_of(damaged);
    }
  }
}

TEST(Jpeg, IsWholeUpToItsEndMarker) {
  const std::string jpeg = fixture();
  EXPECT_TRUE(is_whole_jpeg(jpeg));
  EXPECT_FALSE(is_whole_jpeg(jpeg.substr(0, jpeg.size() - 1)));
  EXPECT_FALSE(is_whole_jpeg(""));
  EXPECT_FALSE(is_whole_jpeg("\xFF\xD8"));
  EXPECT_FALSE(is_whole_jpeg("\xFF\xD8\xFF\xD9"));  // nothing in it
}

TEST(Jpeg, ThumbnailInsideDoesNotEndIt) {
  const std::string jpeg = fixture(), thumbnail = encoded(".jpg", colours());
  const auto size = static_cast<unsigned>(thumbnail.size() + 2);
  const std::string segment =
      std::string("\xFF\xE1") + static_cast<char>(size >> 8U) + static_cast<char>(size) + thumbnail;
  const std::string with_thumbnail = jpeg.substr(0, 2) + segment + jpeg.substr(2);
  EXPECT_TRUE(is_whole_jpeg(with_thumbnail));
  EXPECT_FALSE(is_whole_jpeg(with_thumbnail.substr(0, with_thumbnail.size() - 100)));
}

}  // namespace
}  // namespace geoloc::io
