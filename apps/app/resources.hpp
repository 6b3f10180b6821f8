// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace geoloc::apps {

/// Raises the limit of open files as far as the system lets it. Throws std::runtime_error with the remedy
/// where that, or the limit of memory, is less than a run needs: its libraries abort when they meet such a
/// limit.
void require_resources();

}  // namespace geoloc::apps
