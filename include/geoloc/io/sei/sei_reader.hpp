// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace geoloc::io {

/// What stands before each unit of a picture.
enum class UnitPrefix {
  kStartCode,  ///< a byte stream
  kLength      ///< its length in four bytes, as containers have it
};

/// What the last user_data_unregistered message with that UUID holds behind it, in a picture of H.265 (ITU-T
/// H.265, 7.3.5 and D.2.7). nullopt where there is none. Takes any bytes.
std::optional<std::string> unregistered_data_h265(const std::array<std::uint8_t, 16>& uuid, UnitPrefix prefix,
                                                  const std::uint8_t* picture, std::size_t size);

}  // namespace geoloc::io
