// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace geoloc::apps {

/// A QR code of a text for a terminal: lines of half blocks, dark on light in any colour scheme. Empty where
/// the text is too long, and in a build without libqrencode.
std::string qr_code(const std::string& text);

}  // namespace geoloc::apps
