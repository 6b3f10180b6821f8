// SPDX-License-Identifier: Apache-2.0
#include "io/stills/survey_frame.hpp"

#include <ogr_srs_api.h>

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "io/gdal_dataset.hpp"

namespace geoloc::io {
namespace {

struct FrameReleaser {
  void operator()(void* frame) const { OSRRelease(frame); }
};
using Frame = std::unique_ptr<void, FrameReleaser>;

/// OpenDroneMap's short form of a UTM zone, as EPSG has it.
std::string epsg_of_utm(const std::string& line) {
  int zone = 0;
  char half = 0;
  const bool is_utm = std::sscanf(line.c_str(), "WGS84 UTM %2d%c", &zone, &half) == 2 && zone >= 1 &&
                      zone <= 60 && (half == 'N' || half == 'S');
  if (!is_utm) return line;
  return "EPSG:" + std::to_string((half == 'N' ? 32600 : 32700) + zone);
}

Frame frame_of(const std::string& definition) {
  Frame frame(OSRNewSpatialReference(nullptr));
  // Nothing is fetched, and no file is opened, for what a file of labels says.
  const bool is_named = definition.rfind("EPSG:", 0) == 0 || definition.rfind("+proj=", 0) == 0;
  if (!is_named || OSRSetFromUserInput(frame.get(), definition.c_str()) != OGRERR_NONE)
    throw std::runtime_error("`" + definition.substr(0, 60) +
                             "` is no coordinate system that is known: EPSG:4326, WGS84 UTM 33N, or +proj=… "
                             "is expected");
  OSRSetAxisMappingStrategy(frame.get(), OAMS_TRADITIONAL_GIS_ORDER);
  return frame;
}

}  // namespace

struct SurveyFrame::Transform {
  explicit Transform(const std::string& definition) {
    const Frame from = frame_of(definition), to = frame_of("EPSG:4326");
    handle = OCTNewCoordinateTransformation(from.get(), to.get());
    if (handle == nullptr) throw std::runtime_error("there is no way from " + definition + " to WGS84");
  }
  ~Transform() { OCTDestroyCoordinateTransformation(handle); }
  Transform(const Transform&) = delete;
  Transform& operator=(const Transform&) = delete;

  OGRCoordinateTransformationH handle = nullptr;
};

SurveyFrame::SurveyFrame(const std::string& line) {
  const GdalErrors quiet;
  transform_ = std::make_unique<Transform>(epsg_of_utm(line));
}

SurveyFrame::~SurveyFrame() = default;

std::optional<Geodetic> SurveyFrame::to_geodetic(double x, double y) const {
  const GdalErrors quiet;
  if (OCTTransform(transform_->handle, 1, &x, &y, nullptr) == 0) return std::nullopt;
  const Geodetic place{y, x};
  if (!is_valid(place) || std::abs(place.longitude_deg) > 180.0) return std::nullopt;
  return place;
}

}  // namespace geoloc::io
