// SPDX-License-Identifier: Apache-2.0
#include "eval/html_table.hpp"

#include "eval/chart.hpp"
#include "geoloc/io/output/markup.hpp"

namespace geoloc::apps {
namespace {

std::string html_row(const std::vector<std::string>& cells, const char* first_cell, const char* cell) {
  std::string html = "<tr>";
  const char* kind = first_cell;
  for (const std::string& text : cells) {
    html += std::string("<") + kind + ">" + io::escape_markup(text) + "</" + std::string(kind, 2) + ">";
    kind = cell;
  }
  return html + "</tr>\n";
}

}  // namespace

std::string to_html(const HtmlTable& table) {
  std::string html = "<div class=\"scroll\"><table>\n";
  if (!table.caption.empty()) html += "<caption>" + io::escape_markup(table.caption) + "</caption>\n";
  html += "<thead>" + html_row(table.header, "th", "th") + "</thead>\n<tbody>\n";
  for (const auto& row : table.rows) html += html_row(row, "th scope=\"row\"", "td");
  return html + "</tbody></table></div>\n";
}

}  // namespace geoloc::apps
