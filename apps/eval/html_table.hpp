// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace geoloc::apps {

/// A table of a page: its first column names the rows, the others are figures.
struct HtmlTable {
  std::string caption;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

/// Scrolls sideways where the screen is narrower. Texts are escaped.
std::string to_html(const HtmlTable& table);

}  // namespace geoloc::apps
