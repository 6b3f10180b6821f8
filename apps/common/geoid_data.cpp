// SPDX-License-Identifier: Apache-2.0
#include "common/geoid_data.hpp"

#include "common/data_files.hpp"

namespace geoloc::apps {

io::Geoid open_geoid() {
  const auto folder = look_for_data("geoids");
  return io::Geoid(folder ? std::vector<std::string>{"", folder->string()} : std::vector<std::string>{""});
}

}  // namespace geoloc::apps
