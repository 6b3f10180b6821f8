// SPDX-License-Identifier: Apache-2.0
#include "run_files.hpp"

#include <algorithm>

#include "geoloc/io/output/geojson.hpp"
#include "geoloc/io/output/gpx.hpp"
#include "geoloc/io/output/kml.hpp"

namespace geoloc::io {
namespace {

constexpr std::chrono::seconds kFresh{1};

struct Format {
  const char* path;
  const char* type;
  std::string (*render)(const RunRecord& run);
};

std::string render_geojson(const RunRecord& run) {
  return objects_to_geojson(run.objects, run.estimator);
}

constexpr std::array kFormats{
    Format{"/objects.geojson", "application/geo+json", render_geojson},
    Format{"/objects.kml", "application/vnd.google-earth.kml+xml", run_to_kml},
    Format{"/objects.gpx", "application/gpx+xml", run_to_gpx},
};

}  // namespace

std::optional<RunFiles::File> RunFiles::find(const std::string& path) {
  const auto* const format =
      std::find_if(kFormats.begin(), kFormats.end(), [&](const Format& one) { return path == one.path; });
  if (format == kFormats.end()) return std::nullopt;
  const std::lock_guard lock(mutex_);
  Made& made = made_[static_cast<std::size_t>(format - kFormats.begin())];
  const std::uint64_t revision = document_.revision();
  const bool is_fresh = !made.content.empty() && Clock::now() - made.at < kFresh;
  if (made.revision != revision && !is_fresh)
    made = {format->render(document_.record()), revision, Clock::now()};
  return File{format->type, made.content};
}

}  // namespace geoloc::io
