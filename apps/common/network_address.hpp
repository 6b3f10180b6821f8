// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace geoloc::apps {

/// An IPv4 address by which other devices can reach this computer: of the first interface that is up and is
/// neither the loopback nor a bridge of containers. nullopt without a network.
std::optional<std::string> network_address();

}  // namespace geoloc::apps
