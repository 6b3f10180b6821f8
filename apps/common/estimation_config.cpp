// SPDX-License-Identifier: Apache-2.0
#include "common/estimation_config.hpp"

#include <stdexcept>

#include "common/config_section.hpp"
#include "geoloc/io/config/geolocator_fields.hpp"
#include "geoloc/io/json/camera_file.hpp"

namespace geoloc {

namespace io {

template <class Visitor>
void visit_fields(Visitor& v, MavlinkConfig& mavlink) {
  v.field("system_id", mavlink.system_id, "of the vehicle, 1-255; 0: the first autopilot heard");
  v.field("component_id", mavlink.component_id, "our own");
  v.field("attitude_rate_hz", mavlink.attitude_rate_hz, "Hz, asked for");
  v.field("position_rate_hz", mavlink.position_rate_hz, "Hz, asked for");
  v.field("link_timeout_s", mavlink.link_timeout_s, "s of silence; then everything is asked for anew");
  v.field("camera", mavlink.camera, "be a camera component that tells where objects are (docs/outputs.md)");
  v.field("camera_component_id", mavlink.camera_component_id, "its number, 100-105");
  v.field("status_text", mavlink.status_text, "STATUSTEXT for each object that is confirmed");
}

template <class Visitor>
void visit_fields(Visitor& v, LivePageConfig& page) {
  v.field("max_pages", page.max_pages, "open at a time; a further one is refused");
  v.field("update_period_s", page.update_period_s, "s, a page gets news no more often");
  v.field("write_timeout_s", page.write_timeout_s, "s, a page that takes nothing for so long is dropped");
  v.field("picture_width_px", page.picture_width_px, "px, of the video's pictures on the page");
  v.field("picture_period_s", page.picture_period_s, "s between them at least");
  v.field("tile_url", page.tile_url, "of a background map, with {z}, {x}, {y}; empty: a metric grid alone");
  v.field("tile_attribution", page.tile_attribution, "what the map's maker wants to be read beside it");
}

template <class Visitor>
void visit_fields(Visitor& v, CotConfig& cot) {
  v.field("uid_prefix", cot.uid_prefix, "of every object's uid");
  v.field("type", cot.type, "CoT type of objects: unknown, on the ground");
  v.field("types", cot.types, "CoT types by class name: `{\"car\": \"a-n-G-E-V-C\"}`");
  v.field("period_s", cot.period_s, "s, an object is sent again so often");
  v.field("stale_s", cot.stale_s, "s after its last event it is out of date");
  v.field("error_probability", cot.error_probability, "that ce and le hold the object; 0.9: CE90 and LE90");
  v.field("sigma_height_m", cot.sigma_height_m, "m, 1-sigma of the ground above sea level");
  v.field("multicast_ttl", cot.multicast_ttl, "networks that a multicast datagram may cross");
  v.field("multicast_interface", cot.multicast_interface, "its name; empty: the system chooses");
}

}  // namespace io

namespace apps {

template <class Visitor>
void visit_fields(Visitor& v, FrameConfig& frames) {
  v.field("max_wait_s", frames.max_wait_s, "s, for the vehicle's state around a frame");
}

nlohmann::ordered_json estimation_to_json(const EstimationConfig& config) {
  auto json = io::geolocator_to_json(config.geolocator);
  json["mavlink"] = section_to_json(config.mavlink);
  json["frames"] = section_to_json(config.frames);
  json["live_page"] = section_to_json(config.live_page);
  json["cot"] = section_to_json(config.cot);
  return json;
}

std::vector<io::FieldLine> estimation_field_lines() {
  auto lines = io::geolocator_field_lines();
  list_section<io::MavlinkConfig>("mavlink", lines);
  list_section<FrameConfig>("frames", lines);
  list_section<io::LivePageConfig>("live_page", lines);
  list_section<io::CotConfig>("cot", lines);
  return lines;
}

void estimation_from_json(const nlohmann::json& document, const std::vector<std::string>& ignored_sections,
                          EstimationConfig& config, std::vector<std::string>& problems) {
  nlohmann::json rest = document;
  if (document.is_object()) {
    read_section(document, "mavlink", config.mavlink, problems);
    read_section(document, "frames", config.frames, problems);
    read_section(document, "live_page", config.live_page, problems);
    read_section(document, "cot", config.cot, problems);
    for (const char* section : {"mavlink", "frames", "live_page", "cot"}) rest.erase(section);
    for (const std::string& section : ignored_sections) rest.erase(section);
  }
  io::geolocator_from_json(rest, config.geolocator, problems);
  for (const auto& found : {config.mavlink.problems(), config.live_page.problems(), config.cot.problems()}) {
    problems.insert(problems.end(), found.begin(), found.end());
  }
  if (!(config.frames.max_wait_s >= 0.0 && config.frames.max_wait_s <= 60.0)) {
    problems.emplace_back("frames.max_wait_s must lie in [0, 60]");
  }
}

nlohmann::json read_config_document(const std::string& file) {
  const std::string text = io::read_text_file(file);
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(file + ": not JSON: " + error.what());
  }
}

void refuse_problems(const std::string& file, const std::vector<std::string>& problems) {
  if (problems.empty()) return;
  std::string all;
  for (const std::string& problem : problems) all += "\n  " + problem;
  throw std::runtime_error(file + ": unusable configuration:" + all);
}

}  // namespace apps
}  // namespace geoloc
