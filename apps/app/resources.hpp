// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace geoloc::apps {

/// To be called before any thread begins. Each of some 25 threads would keep freed memory in an arena of its
/// own, pictures among it: 350 MB after a quarter of an hour of streams that come and go, and growing, of
/// which 100 are in use. With two arenas, and pictures apart from them, the program stays below 190 MB.
void keep_memory_compact();

/// Gives freed memory back to the system. What a stream's start needs for a few seconds, some megabytes, lies
/// between blocks that stay; the C library would keep it for ever, and more with each start that needs more.
void give_back_memory();

/// Raises the limit of open files as far as the system lets it. Throws std::runtime_error with the remedy
/// where that, or the limit of memory, is less than a run needs: its libraries abort when they meet such a
/// limit.
void require_resources();

}  // namespace geoloc::apps
