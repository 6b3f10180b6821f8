// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/palette.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace geoloc::io {
namespace {

constexpr ColourScheme kBothSchemes[] = {ColourScheme::kLight, ColourScheme::kDark};

/// Relative luminance of "#rrggbb" (WCAG 2.1).
double luminance(const std::string& colour) {
  const double weights[] = {0.2126, 0.7152, 0.0722};
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double value = std::stoi(colour.substr(1 + 2 * i, 2), nullptr, 16) / 255.0;
    sum += weights[i] * (value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
  }
  return sum;
}

double contrast(const std::string& one, const std::string& other, ColourScheme scheme) {
  const double a = luminance(palette_colour(one, scheme)), b = luminance(palette_colour(other, scheme));
  return (std::max(a, b) + 0.05) / (std::min(a, b) + 0.05);
}

TEST(Palette, TextsAndMarksStandOutAsWcagAsks) {
  for (const ColourScheme scheme : kBothSchemes) {
    for (const char* ground : {"page", "card", "map"}) {
      for (const char* text : {"ink", "soft", "good", "bad", "best"}) {
        EXPECT_GE(contrast(text, ground, scheme), 4.5) << text << " on " << ground;
      }
    }
    for (const char* mark : {"object", "tentative", "raw", "trajectory", "footprint", "target", "vehicle"}) {
      EXPECT_GE(contrast(mark, "map", scheme), 3.0) << mark;
    }
    EXPECT_GE(contrast("card", "bad", scheme), 4.5);  // the notice
  }
}

TEST(Palette, PutsColoursInPlaceOfVariables) {
  const std::string css = with_colours(".a{fill:var(--object);stroke:var(--map)}", ColourScheme::kDark);
  EXPECT_EQ(css, ".a{fill:" + palette_colour("object", ColourScheme::kDark) +
                     ";stroke:" + palette_colour("map", ColourScheme::kDark) + "}");
  EXPECT_NE(palette_colour("map", ColourScheme::kDark), palette_colour("map", ColourScheme::kLight));
  EXPECT_THROW(palette_colour("none", ColourScheme::kLight), std::out_of_range);
}

}  // namespace
}  // namespace geoloc::io
