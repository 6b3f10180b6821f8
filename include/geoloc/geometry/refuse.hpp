// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace geoloc {

/// Of a constructor that was given what cannot be: throws std::invalid_argument with the reason. Where the
/// library was built without exceptions, the reason goes to stderr, and the program is aborted: what such
/// software builds, it checks first, by problems() or by Geolocator::create().
[[noreturn]] void refuse(const std::string& reason);

/// Refuses by naming all of them, unless there are none.
void refuse_if_any(const std::vector<std::string>& problems);

}  // namespace geoloc
