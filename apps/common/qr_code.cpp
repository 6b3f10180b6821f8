// SPDX-License-Identifier: Apache-2.0
#include "common/qr_code.hpp"

#include <qrencode.h>

#include <memory>

namespace geoloc::apps {
namespace {

constexpr int kQuiet = 2;  // modules of light around the code
constexpr const char* kDarkOnLight = "\033[30;47m";
constexpr const char* kUsual = "\033[0m";

/// Beyond the code, all is light.
bool is_dark(const QRcode& code, int x, int y) {
  const bool is_inside = x >= 0 && y >= 0 && x < code.width && y < code.width;
  return is_inside && (code.data[y * code.width + x] & 1) != 0;
}

/// Two modules, one above the other.
const char* block(bool is_upper_dark, bool is_lower_dark) {
  if (is_upper_dark) return is_lower_dark ? "█" : "▀";
  return is_lower_dark ? "▄" : " ";
}

}  // namespace

std::string qr_code(const std::string& text) {
  const std::unique_ptr<QRcode, decltype(&QRcode_free)> code(
      QRcode_encodeString8bit(text.c_str(), 0, QR_ECLEVEL_M), &QRcode_free);
  if (!code) return {};
  std::string lines;
  for (int y = -kQuiet; y < code->width + kQuiet; y += 2) {
    lines += kDarkOnLight;
    for (int x = -kQuiet; x < code->width + kQuiet; ++x)
      lines += block(is_dark(*code, x, y), is_dark(*code, x, y + 1));
    lines += std::string(kUsual) + "\n";
  }
  return lines;
}

}  // namespace geoloc::apps
