// SPDX-License-Identifier: Apache-2.0
#include "common/sinks.hpp"

#include <algorithm>

#include "geoloc/io/output/cot_sink.hpp"
#include "geoloc/io/output/csv.hpp"
#include "geoloc/io/output/file_sink.hpp"
#include "geoloc/io/output/geojson.hpp"
#include "geoloc/io/output/json_lines_sink.hpp"
#include "geoloc/io/output/kml.hpp"
#include "geoloc/io/output/raw_fixes.hpp"
#include "geoloc/io/output/run_picture.hpp"

namespace geoloc::apps {
namespace {

std::string raw_csv(const io::RunRecord& run) {
  return io::raw_fixes_to_csv(run.raw_fixes, run.local_frame.value_or(LocalFrame({0.0, 0.0})));
}

}  // namespace

bool OutputFiles::has_objects() const {
  return !objects.empty() || std::find(jsonl.begin(), jsonl.end(), "-") != jsonl.end();
}

void add_sinks(const OutputFiles& files, const EstimationConfig& config, Outputs& outputs) {
  const auto add = [&outputs](const char* option, const std::string& file, io::FileSink::Render render) {
    if (!file.empty()) outputs.add(std::make_unique<io::FileSink>(option, file, std::move(render)));
  };
  add("--out", files.objects,
      [](const io::RunRecord& run) { return io::objects_to_geojson(run.objects, run.estimator); });
  add("--raw", files.raw, raw_csv);
  add("--csv", files.csv, [](const io::RunRecord& run) { return io::objects_to_csv(run.objects); });
  add("--kml", files.kml, io::run_to_kml);
  for (const std::string& target : files.jsonl) outputs.add(std::make_unique<io::JsonLinesSink>(target));
  for (const std::string& target : files.cot)
    outputs.add(std::make_unique<io::CotSink>(target, config.cot, outputs.teller()));
  add("--picture", files.picture, [](const io::RunRecord& run) { return io::to_svg(io::picture_of(run)); });
}

}  // namespace geoloc::apps
