// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/markup.hpp"

#include "geoloc/io/output/text.hpp"

namespace geoloc::io {

std::string escape_markup(const std::string& text) {
  std::string result;
  for (const char character : clean_text(text)) {
    switch (character) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += character;
    }
  }
  return result;
}

}  // namespace geoloc::io
