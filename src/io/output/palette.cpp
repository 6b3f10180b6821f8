// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/palette.hpp"

#include <stdexcept>

#include "palette_file.hpp"

namespace geoloc::io {
namespace {

constexpr std::string_view kVariable = "var(--";

}  // namespace

std::string_view palette_css() {
  return palette_files().front().content;
}

std::string palette_colour(const std::string& name, ColourScheme scheme) {
  const std::string_view css = palette_css();
  const std::string property = "--" + name + ": ";
  std::size_t begin = css.find(property);
  if (scheme == ColourScheme::kDark && begin != css.npos) begin = css.find(property, begin + 1);
  if (begin == css.npos) throw std::out_of_range("the palette has no colour " + name);
  begin += property.size();
  return std::string(css.substr(begin, css.find(';', begin) - begin));
}

std::string with_colours(const std::string& css, ColourScheme scheme) {
  std::string result = css;
  for (std::size_t at = result.find(kVariable); at != result.npos; at = result.find(kVariable, at)) {
    const std::size_t end = result.find(')', at);
    const std::size_t name = at + kVariable.size();
    result.replace(at, end + 1 - at, palette_colour(result.substr(name, end - name), scheme));
  }
  return result;
}

}  // namespace geoloc::io
