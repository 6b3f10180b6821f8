// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string_view>

namespace geoloc::io {

/// Whether the file begins like a picture in a format that read_picture() knows.
bool is_picture(const std::filesystem::path& file);

/// A picture of any format that OpenCV reads (JPEG, PNG, TIFF, BMP, WebP, …) as BGR of 8 bits: grey becomes
/// BGR, 16 bits are rounded to 8, transparency is dropped, and the picture is rotated as its metadata says.
/// Throws std::runtime_error naming the file and the fault: not readable, empty, no picture, damaged or
/// truncated, more than 200 million pixels (before memory for them is taken), values that are no integers.
cv::Mat read_picture(const std::filesystem::path& file);

/// Whether bytes that begin as a JPEG continue to its end marker; decoders fill missing parts with grey.
/// Takes any bytes.
bool is_whole_jpeg(std::string_view bytes);

}  // namespace geoloc::io
