// SPDX-License-Identifier: Apache-2.0
#include "app/live_config.hpp"

#include "app/live_fields.hpp"
#include "io/config/settings_json.hpp"
#include "io/json/field_lister.hpp"
#include "io/json/field_writer.hpp"

namespace geoloc::apps {

nlohmann::ordered_json live_to_json(const LiveConfig& config) {
  return io::fields_to_json(config);
}

std::string live_settings_table() {
  std::vector<io::FieldLine> lines;
  io::FieldLister lister(lines);
  LiveConfig defaults;
  visit_fields(lister, defaults);
  std::string table = "| setting | default | range | unit | meaning |\n|---|---|---|---|---|\n";
  for (const io::FieldLine& line : lines) {
    table += "| `" + line.path + "` | `" + line.default_value + "` | " + line.range + " | " + line.unit +
             " | " + line.meaning + " |\n";
  }
  return table;
}

void live_from_json(const nlohmann::json& document, LiveConfig& config, std::vector<std::string>& problems) {
  io::settings_from_json(document, {}, config.estimation.geolocator.camera, config, problems);
}

}  // namespace geoloc::apps
