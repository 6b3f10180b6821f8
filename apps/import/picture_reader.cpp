// SPDX-License-Identifier: Apache-2.0
#include "import/picture_reader.hpp"

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "common/last_words.hpp"
#include "common/progress_line.hpp"
#include "geoloc/io/picture/picture_file.hpp"

namespace geoloc::apps {
namespace {

namespace fs = std::filesystem;

/// Beyond any camera's pictures.
constexpr std::uintmax_t kLargestFile = 500'000'000;

std::string read_bytes(const fs::path& file) {
  if (fs::file_size(file) > kLargestFile) throw std::runtime_error("is too large for a picture");
  std::ifstream stream(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>{stream}, {}};
  if (!stream) throw std::runtime_error("cannot be read");
  return bytes;
}

io::Still read_still(const fs::path& file) {
  const std::string bytes = read_bytes(file);
  const io::PictureTags tags = io::parse_picture_tags(bytes);
  if (!io::is_whole_jpeg(bytes)) throw std::runtime_error("is cut short");
  return io::still_of(tags);
}

}  // namespace

ReadStills read_stills(const std::vector<fs::path>& files, const StopSignal& stop) {
  ReadStills read;
  ProgressLine progress("reading pictures", files.size());
  std::size_t done = 0;
  for (const fs::path& file : files) {
    if (stop.is_requested()) break;
    try {
      read.stills.push_back({file, read_still(file)});
    } catch (const std::exception& error) {
      read.left_out.push_back(file.string() + ": " + reason_of(error));
    }
    progress.show(++done);
  }
  progress.finish();
  return read;
}

}  // namespace geoloc::apps
