// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/recording/object_pictures.hpp"

#include <charconv>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>

#include "geoloc/io/recording/recording_files.hpp"

namespace geoloc::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostPictures = 2000;
constexpr std::uintmax_t kLargest_bytes = 256 << 10;
constexpr const char* kJpegBegins = "\xff\xd8\xff";

/// "17" of "17.jpg".
std::optional<std::uint64_t> object_of_name(const fs::path& file) {
  const std::string stem = file.stem().string();
  std::uint64_t id = 0;
  const char* const end = stem.data() + stem.size();
  const auto [stopped_at, error] = std::from_chars(stem.data(), end, id);
  const bool is_id = error == std::errc{} && stopped_at == end && file.extension() == ".jpg";
  return is_id ? std::optional(id) : std::nullopt;
}

}  // namespace

std::map<std::uint64_t, std::string> read_object_pictures(const fs::path& folder) {
  std::map<std::uint64_t, std::string> pictures;
  std::error_code error;
  for (fs::directory_iterator file(folder / kPicturesFolder, error), end; !error && file != end;
       file.increment(error)) {
    const auto id = object_of_name(file->path());
    std::error_code unreadable;
    const bool is_small = file->is_regular_file(unreadable) && file->file_size(unreadable) <= kLargest_bytes;
    if (!id || unreadable || !is_small || pictures.size() >= kMostPictures) continue;
    std::ifstream input(file->path(), std::ios::binary);
    std::string jpeg{std::istreambuf_iterator<char>(input), std::istreambuf_iterator<char>()};
    if (input && jpeg.rfind(kJpegBegins, 0) == 0) pictures.emplace(*id, std::move(jpeg));
  }
  return pictures;
}

}  // namespace geoloc::io
