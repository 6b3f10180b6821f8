// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

// Values of MAV_COMPONENT, MAV_CMD and MAV_RESULT, for files that would otherwise need the large generated
// headers.
namespace geoloc::io {

inline constexpr std::uint8_t kAutopilotComponent = 1;
inline constexpr std::uint8_t kFirstGimbalComponent = 154;
inline constexpr std::uint8_t kSecondGimbalComponent = 171;  // to the sixth they are in a row
inline constexpr std::uint8_t kLastGimbalComponent = 175;

inline constexpr std::uint8_t kFirstCameraComponent = 100;
inline constexpr std::uint8_t kLastCameraComponent = 105;

inline constexpr std::uint16_t kSetMessageInterval = 511;
inline constexpr std::uint16_t kRequestMessage = 512;
inline constexpr std::uint16_t kRequestCameraInformation = 521;
inline constexpr std::uint16_t kTrackPoint = 2004;
inline constexpr std::uint16_t kStopTracking = 2010;

inline constexpr std::uint8_t kAccepted = 0;
inline constexpr std::uint8_t kRejectedForNow = 1;
inline constexpr std::uint8_t kDenied = 2;
inline constexpr std::uint8_t kUnsupported = 3;
inline constexpr std::uint8_t kInProgress = 5;

}  // namespace geoloc::io
