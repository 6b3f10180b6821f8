// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace geoloc::io {

enum class VideoCodec { kH264, kH265 };

/// True if the RTP payload (RFC 6184 or RFC 7798) holds the beginning of a picture that refers to no earlier
/// one: an IDR picture of H.264, a random access point of H.265. Takes any bytes.
bool begins_random_access_picture(VideoCodec codec, const std::uint8_t* payload, std::size_t size);

}  // namespace geoloc::io
