// SPDX-License-Identifier: Apache-2.0
#include "detect/inputs.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>

#include "geoloc/io/picture/picture_file.hpp"

namespace geoloc::apps {
namespace {

namespace fs = std::filesystem;

/// A damaged picture is still meant as one.
bool is_named_like_a_picture(const fs::path& file) {
  static constexpr std::array kEndings{".jpg", ".jpeg", ".png", ".bmp", ".tif", ".tiff", ".webp"};
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
}

std::vector<DetectInput> pictures_in(const fs::path& folder) {
  std::vector<DetectInput> pictures;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && (is_named_like_a_picture(entry.path()) || io::is_picture(entry.path())))
      pictures.push_back({entry.path(), false});
  }
  if (pictures.empty()) throw std::runtime_error(folder.string() + ": there is no picture in this folder");
  std::sort(pictures.begin(), pictures.end(),
            [](const DetectInput& a, const DetectInput& b) { return a.file < b.file; });
  return pictures;
}

}  // namespace

std::vector<DetectInput> find_inputs(const std::vector<std::string>& given) {
  std::vector<DetectInput> inputs;
  for (const fs::path file : given) {
    if (fs::is_directory(file)) {
      const auto pictures = pictures_in(file);
      inputs.insert(inputs.end(), pictures.begin(), pictures.end());
    } else if (fs::is_regular_file(file)) {
      inputs.push_back({file, !is_named_like_a_picture(file) && !io::is_picture(file)});
    } else {
      throw std::runtime_error(file.string() + ": there is no such file or folder");
    }
  }
  return inputs;
}

}  // namespace geoloc::apps
