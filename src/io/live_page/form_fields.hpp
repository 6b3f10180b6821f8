// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace geoloc::io {

/// The value of "name=value" in an address's query "name=value&…", with %XX and + decoded. nullopt where the
/// query does not have it, or with a broken %XX.
std::optional<std::string> form_field(std::string_view query, std::string_view name);

}  // namespace geoloc::io
