// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace geoloc::io {

/// Text for XML 1.0 and HTML: markup is escaped, control characters are left out.
std::string escape_markup(const std::string& text);

}  // namespace geoloc::io
