// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/picture/picture_file.hpp"

#include <fstream>
#include <iterator>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "pixel_limit.hpp"

namespace geoloc::io {
namespace {

constexpr std::uintmax_t kLargestFile = 2'000'000'000;

/// Beyond any camera; the memory of a picture is three times as many bytes, or six.
constexpr std::int64_t kMostPixels = 200'000'000;

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& fault) {
  throw std::runtime_error(file.string() + ": " + fault);
}

/// WebP's decoder wants unsigned ones.
std::vector<unsigned char> read_bytes(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) fail(file, "cannot be read: " + error.message());
  if (size == 0) fail(file, "is empty");
  if (size > kLargestFile) fail(file, "is too large for a picture");
  std::ifstream stream{file, std::ios::binary};
  std::vector<unsigned char> bytes{std::istreambuf_iterator<char>{stream}, {}};
  if (!stream || bytes.empty()) fail(file, "cannot be read");
  return bytes;
}

/// Decodes the file; empty if it is no picture.
cv::Mat decode(const std::filesystem::path& file, const std::vector<unsigned char>& bytes) {
  const auto level = cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  cv::Mat picture;
  std::string fault;
  try {
    const PixelLimit limit(kMostPixels);
    picture = cv::imdecode(bytes, cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH);
  } catch (const PixelLimit::TooManyPixels& size) {
    fault = std::string("has ") + size.what() + " pixels; pictures of more than " +
            std::to_string(kMostPixels / 1'000'000) + " million are not read";
  } catch (const cv::Exception& error) {
    fault = "cannot be decoded; too large? (" + error.err + ")";
  } catch (const std::bad_alloc&) {
    fault = "needs more memory than there is";
  }
  cv::utils::logging::setLogLevel(level);
  if (!fault.empty()) fail(file, fault);
  return picture;
}

}  // namespace

bool is_picture(const std::filesystem::path& file) {
  std::error_code error;
  return std::filesystem::is_regular_file(file, error) && cv::haveImageReader(file.string());
}

cv::Mat read_picture(const std::filesystem::path& file) {
  const std::vector<unsigned char> bytes = read_bytes(file);
  const std::string_view content{reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  constexpr std::string_view kJpeg{"\xFF\xD8\xFF"};
  if (content.substr(0, kJpeg.size()) == kJpeg && !is_whole_jpeg(content)) fail(file, "is cut short");
  cv::Mat picture = decode(file, bytes);
  if (picture.empty()) fail(file, "is no picture that can be decoded, damaged, or cut short");
  if (picture.type() == CV_16UC3) picture.convertTo(picture, CV_8U, 1.0 / 257.0);
  if (picture.type() != CV_8UC3) fail(file, "has values that are no integers of 8 or 16 bits");
  return picture;
}

}  // namespace geoloc::io
