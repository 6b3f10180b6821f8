// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace geoloc::io {

enum class ColourScheme { kLight, kDark };

/// The colours of everything geoloc draws, src/io/output/palette.css: custom properties on :root, light, and
/// dark where a reader prefers it.
std::string_view palette_css();

/// "#0067b1" of "object". Throws std::out_of_range for a name that the palette lacks.
std::string palette_colour(const std::string& name, ColourScheme scheme);

/// `css` with a colour in place of each "var(--NAME)", for pictures, because their viewers may not support
/// custom properties.
std::string with_colours(const std::string& css, ColourScheme scheme);

}  // namespace geoloc::io
