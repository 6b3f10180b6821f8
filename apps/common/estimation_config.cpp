// SPDX-License-Identifier: Apache-2.0
#include "common/estimation_config.hpp"

#include <algorithm>
#include <stdexcept>

#include "common/estimation_fields.hpp"
#include "geoloc/io/text_file.hpp"
#include "io/config/settings_json.hpp"
#include "io/json/field_writer.hpp"

namespace geoloc::apps {

nlohmann::ordered_json estimation_to_json(const EstimationConfig& config) {
  return io::fields_to_json(config);
}

void estimation_from_json(const nlohmann::json& document, const std::vector<std::string>& ignored_sections,
                          EstimationConfig& config, std::vector<std::string>& problems) {
  io::settings_from_json(document, ignored_sections, config.geolocator.camera, config, problems);
}

nlohmann::json read_config_document(const std::string& file) {
  const std::string text = io::read_text_file(file);
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(file + ": not JSON: " + error.what());
  }
}

NamedFiles files_of_config(const std::string& file) {
  if (file.empty()) return {};
  NamedFiles files{{"--config", file}};
  const nlohmann::json document = read_config_document(file);
  for (const std::string setting : {"camera", "mavlink.signing_key_file", "cot.tls_ca_file",
                                    "cot.tls_client_file", "cot.tls_key_file", "cot.tls_password_file"}) {
    std::string path = "/" + setting;
    std::replace(path.begin(), path.end(), '.', '/');
    const nlohmann::json::json_pointer place(path);
    if (document.contains(place) && document[place].is_string())
      add_named(files, setting + " in --config", document[place].get<std::string>());
  }
  return files;
}

void refuse_problems(const std::string& file, const std::vector<std::string>& problems) {
  if (problems.empty()) return;
  std::string all;
  for (const std::string& problem : problems) all += "\n  " + problem;
  throw std::runtime_error(file + ": unusable configuration:" + all);
}

}  // namespace geoloc::apps
