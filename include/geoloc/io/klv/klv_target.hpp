// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "geoloc/io/endpoint.hpp"

namespace geoloc::io {

/// The receiver of "udp://HOST:PORT"; nullopt for the name of a file. Throws std::invalid_argument that shows
/// the text where it is neither.
std::optional<Endpoint> parse_klv_target(const std::string& target);

}  // namespace geoloc::io
