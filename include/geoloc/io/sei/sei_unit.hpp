// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace geoloc::io {

/// A NAL unit of H.264 with one user_data_unregistered message (ITU-T H.264, 7.3.2.3 and D.1.7), with its
/// start code and its emulation prevention bytes.
std::vector<std::uint8_t> sei_unit(const std::array<std::uint8_t, 16>& uuid, std::string_view data);

/// Where the first slice of a picture begins, with its start code, in an access unit of H.264's byte stream
/// (annex B); `size` where there is none. What tells of the picture goes before it. Takes any bytes.
std::size_t first_slice(const std::uint8_t* access_unit, std::size_t size);

}  // namespace geoloc::io
