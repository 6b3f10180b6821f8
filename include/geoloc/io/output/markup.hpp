// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace geoloc::io {

/// Text for XML 1.0 and HTML, content or attribute: clean_text() with its markup escaped.
std::string escape_markup(const std::string& text);

}  // namespace geoloc::io
