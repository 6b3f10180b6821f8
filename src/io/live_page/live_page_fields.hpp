// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/io/live_page/live_page_config.hpp"
#include "settings/rules.hpp"

namespace geoloc::io {

/// Empty: no background map.
inline bool is_tile_url(const std::string& text) {
  return text.empty() || !tile_origin(text).empty();
}

template <class Visitor>
void visit_fields(Visitor& v, LivePageConfig& page) {
  v.field("max_pages", page.max_pages, Range::closed(1, 1000), "",
          "Pages open at a time; further ones are rejected");
  v.field("update_period_s", page.update_period_s, Range::closed(0.02, 10), "s",
          "Least time between two updates of a page");
  v.field("write_timeout_s", page.write_timeout_s, Range::closed(0.1, 60), "s",
          "A page that accepts no data for this long is dropped");
  v.field("picture_width_px", page.picture_width_px, Range::closed(160, 3840), "px",
          "Width of the video's pictures on the page");
  v.field("picture_period_s", page.picture_period_s, Range::closed(0.02, 60), "s",
          "Least time between two pictures");
  v.field("tile_url", page.tile_url, Form{&is_tile_url, "http(s)://HOST/… with {z}, {x} and {y}, or empty"},
          "", "Tiles of a background map; empty: a metric grid alone");
  v.field("tile_attribution", page.tile_attribution, Any{}, "",
          "What the map's maker wants to be read beside it");
}

}  // namespace geoloc::io
