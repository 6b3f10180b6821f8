// SPDX-License-Identifier: Apache-2.0
#include "app/live_config.hpp"

#include <array>
#include <utility>

#include "common/config_section.hpp"

namespace geoloc::io {

template <>
struct EnumNames<RtspTransport> {
  static constexpr std::array<std::pair<RtspTransport, const char*>, 2> all{
      {{RtspTransport::kTcp, "tcp"}, {RtspTransport::kUdp, "udp"}}};
};

template <>
struct EnumNames<Backend> {
  static constexpr std::array<std::pair<Backend, const char*>, 2> all{
      {{Backend::kOpencv, "opencv"}, {Backend::kOpenvino, "openvino"}}};
};

template <class Visitor>
void visit_fields(Visitor& v, VideoConfig& video) {
  v.field("transport", video.transport, "tcp, or udp");
  v.field("latency_s", video.latency_s,
          "s, exposure to arrival where the stream does not tell the capture time");
  v.field("reorder_s", video.reorder_s, "s, how long UDP packets out of order are waited for");
  v.field("frame_timeout_s", video.frame_timeout_s, "s without a frame; then connect anew");
  v.field("connect_timeout_s", video.connect_timeout_s, "s without a first frame; then connect anew");
  v.field("retry_min_s", video.retry_min_s, "s between attempts; doubles while they fail");
  v.field("retry_max_s", video.retry_max_s, "s between attempts at most");
  v.field("max_megapixels", video.max_megapixels, "larger pictures are refused");
}

template <class Visitor>
void visit_fields(Visitor& v, SecondLookConfig& second_look) {
  v.field(
      "confidence", second_look.confidence,
      "of the first look, from which on boxes are looked at once more, by models that have a network for it");
  v.field("max_boxes", second_look.max_boxes, "in a picture, the most confident ones");
}

template <class Visitor>
void visit_fields(Visitor& v, DetectionConfig& detection) {
  v.field("confidence", detection.confidence, "boxes with a lower score are dropped");
  v.field("nms_iou", detection.nms_iou,
          "of two boxes of a class that overlap more, the more confident one stays");
  v.field("max_detections", detection.max_detections, "in a picture");
  v.field("threads", detection.threads, "of what runs the network; 0: as many as there are cores");
  v.field("backend", detection.backend, "what runs the network: opencv, or openvino where it was built in");
  v.field("input_width_px", detection.input_width_px,
          "px, of the network's input, for models that leave it open; 0: the model's own");
  v.field("input_height_px", detection.input_height_px, "px, likewise");
  v.field("tile_columns", detection.tile_columns,
          "a picture is cut into so many tiles side by side, each searched as well; 1 x 1: not cut");
  v.field("tile_rows", detection.tile_rows, "likewise, one below the other");
  v.field("tile_overlap_px", detection.tile_overlap_px,
          "px of the picture, of neighbouring tiles: at least the longest object that is small");
  v.section("second_look", detection.second_look);
}

}  // namespace geoloc::io

namespace geoloc::apps {

nlohmann::ordered_json live_to_json(const LiveConfig& config) {
  auto json = estimation_to_json(config.estimation);
  json["video"] = section_to_json(config.video);
  json["detection"] = section_to_json(config.detection);
  return json;
}

std::string live_settings_table() {
  auto lines = estimation_field_lines();
  list_section<io::VideoConfig>("video", lines);
  list_section<io::DetectionConfig>("detection", lines);
  std::string table = "| setting | default | unit and meaning |\n|---|---|---|\n";
  for (const io::FieldLine& line : lines) {
    table += "| `" + line.path + "` | `" + line.default_value + "` | " + line.meaning + " |\n";
  }
  return table;
}

void live_from_json(const nlohmann::json& document, LiveConfig& config, std::vector<std::string>& problems) {
  estimation_from_json(document, {"video", "detection"}, config.estimation, problems);
  read_section(document, "video", config.video, problems);
  read_section(document, "detection", config.detection, problems);
  for (const auto& found : {config.video.problems(), config.detection.problems()}) {
    problems.insert(problems.end(), found.begin(), found.end());
  }
}

}  // namespace geoloc::apps
