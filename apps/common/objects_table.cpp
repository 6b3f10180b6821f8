// SPDX-License-Identifier: Apache-2.0
#include "common/objects_table.hpp"

#include <fmt/format.h>

#include <iterator>

#include "geoloc/io/output/text.hpp"

namespace geoloc::apps {

std::string objects_to_table(const std::vector<io::ObjectReport>& objects) {
  std::string table = fmt::format("{:>5}  {:<16} {:>13} {:>14} {:>8} {:>6}  {}\n", "id", "class", "latitude",
                                  "longitude", "sigma m", "looks", "last seen (UTC)");
  for (const io::ObjectReport& object : objects) {
    fmt::format_to(std::back_inserter(table), "{:>5}  {:<16} {:>13.7f} {:>14.7f} {:>8.2f} {:>6}  {}\n",
                   object.id, io::clean_text(object.class_name, 16), object.position.latitude_deg,
                   object.position.longitude_deg, object.ellipse.sigma_major_m, object.hits,
                   io::iso8601(object.last_seen));
  }
  return table;
}

}  // namespace geoloc::apps
