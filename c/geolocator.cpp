// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>

#include "handles.hpp"
#include "inputs.hpp"
#include "last_error.hpp"
#include "outputs.hpp"

static_assert(GEOLOC_FATES == geoloc::kFrameFates, "geoloc_fate lists FrameFate");
static_assert(GEOLOC_UNUSABLE_FOCAL_LENGTH == static_cast<int>(geoloc::FrameFate::kUnusableFocalLength),
              "in its order");

namespace geoloc::c {
namespace {

template <typename Sample>
geoloc_status add(geoloc_geolocator* geolocator, const Sample* given, const char* name) {
  return guarded([&] {
    Geolocator& estimator = required(geolocator, "geolocator").estimator;
    const auto sample = sample_from(required(given, name));
    const StateProvider::Counters before = estimator.state().counters();
    estimator.add(sample);
    const StateProvider::Counters after = estimator.state().counters();
    if (after.out_of_range > before.out_of_range)
      throw BadArgument(std::string(name) + " has angles that no attitude has: radians are meant");
    if (after.invalid > before.invalid)
      throw BadArgument(std::string(name) + " is no place on Earth, or no rotation");
    return GEOLOC_OK;
  });
}

template <typename Source, typename Structure, typename Convert>
geoloc_status write_all(const Source& source, Structure* target, std::size_t capacity, std::size_t* count,
                        const Convert& convert) {
  if (capacity > 0) required(target, "the array");
  required(count, "count") = source.size();
  for (std::size_t i = 0; i < std::min(capacity, source.size()); ++i) target[i] = convert(source[i]);
  return GEOLOC_OK;
}

/// BadSetting for settings that `use` refuses.
template <typename Use>
void with_settings(const geoloc_config* config, const Use& use) {
  const GeolocatorConfig& settings = required(config, "config").settings;
  try {
    use(settings);
  } catch (const std::invalid_argument& error) {
    throw BadSetting(error.what());
  }
}

/// For what cannot be asked before the first position; BadArgument for a place that is none.
template <typename Body>
geoloc_status in_local_frame(const geoloc_geolocator* geolocator, const Body& body) {
  return guarded([&] {
    const auto& frame = required(geolocator, "geolocator").estimator.local_frame();
    if (!frame) return GEOLOC_NOTHING;
    body(*frame);
    return GEOLOC_OK;
  });
}

}  // namespace
}  // namespace geoloc::c

extern "C" {

using namespace geoloc::c;

geoloc_status geoloc_memory_needed(const geoloc_config* config, size_t* bytes) {
  return guarded([&] {
    size_t& result = required(bytes, "bytes");
    result = 0;
    with_settings(config, [&](const geoloc::GeolocatorConfig& settings) {
      result = geoloc_geolocator::bytes(settings);
    });
    return GEOLOC_OK;
  });
}

geoloc_status geoloc_create(const geoloc_config* config, geoloc_geolocator** geolocator) {
  return guarded([&] {
    geoloc_geolocator*& result = required(geolocator, "geolocator");
    result = nullptr;
    with_settings(config, [&](const geoloc::GeolocatorConfig& settings) {
      result = std::make_unique<geoloc_geolocator>(settings).release();
    });
    return GEOLOC_OK;
  });
}

void geoloc_destroy(geoloc_geolocator* geolocator) {
  delete geolocator;
}

geoloc_status geoloc_add_attitude(geoloc_geolocator* geolocator, const geoloc_attitude* attitude) {
  return add(geolocator, attitude, "attitude");
}

geoloc_status geoloc_add_position(geoloc_geolocator* geolocator, const geoloc_position* position) {
  return add(geolocator, position, "position");
}

geoloc_status geoloc_add_gimbal(geoloc_geolocator* geolocator, const geoloc_gimbal* gimbal) {
  return add(geolocator, gimbal, "gimbal");
}

geoloc_status geoloc_add_field_of_view(geoloc_geolocator* geolocator,
                                       const geoloc_field_of_view* field_of_view) {
  return add(geolocator, field_of_view, "field_of_view");
}

geoloc_status geoloc_add_range(geoloc_geolocator* geolocator, const geoloc_range* range) {
  return add(geolocator, range, "range");
}

const char* geoloc_explain(int32_t fate) {
  if (fate < 0 || fate >= GEOLOC_FATES) return "this is no frame's fate";
  return geoloc::explain(static_cast<geoloc::FrameFate>(fate));
}

geoloc_status geoloc_add_frame(geoloc_geolocator* geolocator, const geoloc_frame* frame,
                               geoloc_outcome* given_up) {
  return guarded([&] {
    geoloc_geolocator& handle = required(geolocator, "geolocator");
    fill(handle.frame, required(frame, "frame"));
    const auto gone = handle.estimator.add(handle.frame);
    if (!gone) return GEOLOC_OK;
    if (given_up != nullptr) *given_up = to_c(*gone);
    return GEOLOC_FRAME_GIVEN_UP;
  });
}

geoloc_status geoloc_process_next(geoloc_geolocator* geolocator, int32_t wait, geoloc_outcome* outcome) {
  return guarded([&] {
    geoloc_outcome& result = required(outcome, "outcome");
    const auto processed = required(geolocator, "geolocator").estimator.process_next(wait_from(wait));
    if (!processed) return GEOLOC_NOTHING;
    result = to_c(*processed);
    return GEOLOC_OK;
  });
}

geoloc_status geoloc_finish(geoloc_geolocator* geolocator) {
  return guarded([&] {
    required(geolocator, "geolocator").estimator.finish();
    return GEOLOC_OK;
  });
}

geoloc_status geoloc_on_vehicle_reboot(geoloc_geolocator* geolocator) {
  return guarded([&] {
    required(geolocator, "geolocator").estimator.on_vehicle_reboot();
    return GEOLOC_OK;
  });
}

geoloc_status geoloc_on_vehicle_clock_step(geoloc_geolocator* geolocator) {
  return guarded([&] {
    required(geolocator, "geolocator").estimator.on_vehicle_clock_step();
    return GEOLOC_OK;
  });
}

geoloc_status geoloc_objects(const geoloc_geolocator* geolocator, geoloc_object* objects, size_t capacity,
                             size_t* count) {
  return guarded([&] {
    const geoloc::Geolocator& estimator = required(geolocator, "geolocator").estimator;
    return write_all(estimator.tracks(), objects, capacity, count,
                     [&](const geoloc::Track& track) { return to_c(track, *estimator.local_frame()); });
  });
}

geoloc_status geoloc_fixes(const geoloc_geolocator* geolocator, geoloc_fix* fixes, size_t capacity,
                           size_t* count) {
  return guarded([&] {
    const geoloc::Geolocator& estimator = required(geolocator, "geolocator").estimator;
    return write_all(
        estimator.located(), fixes, capacity, count,
        [&](const geoloc::LocatedDetection& located) { return to_c(located, *estimator.local_frame()); });
  });
}

geoloc_status geoloc_camera_pose(const geoloc_geolocator* geolocator, geoloc_pose* pose) {
  return guarded([&] {
    geoloc_pose& result = required(pose, "pose");
    const geoloc::Geolocator& estimator = required(geolocator, "geolocator").estimator;
    if (estimator.counters().frames_located == 0) return GEOLOC_NOTHING;
    result = to_c(estimator.view());
    return GEOLOC_OK;
  });
}

geoloc_status geoloc_calibration_of(const geoloc_geolocator* geolocator, geoloc_calibration* calibration) {
  return guarded([&] {
    geoloc_calibration& result = required(calibration, "calibration");
    const auto learnt = required(geolocator, "geolocator").estimator.calibration();
    if (!learnt) return GEOLOC_NOTHING;
    result = to_c(*learnt);
    return GEOLOC_OK;
  });
}

geoloc_status geoloc_counters_of(const geoloc_geolocator* geolocator, geoloc_counters* counters) {
  return guarded([&] {
    required(counters, "counters") = counters_of(required(geolocator, "geolocator").estimator);
    return GEOLOC_OK;
  });
}

geoloc_status geoloc_to_geodetic(const geoloc_geolocator* geolocator, double east_m, double north_m,
                                 double* latitude_deg, double* longitude_deg) {
  return in_local_frame(geolocator, [&](const geoloc::LocalFrame& frame) {
    if (!std::isfinite(east_m) || !std::isfinite(north_m))
      throw BadArgument("east_m or north_m is not a finite number");
    double& longitude = required(longitude_deg, "longitude_deg");
    const geoloc::Geodetic where = frame.to_geodetic({east_m, north_m});
    required(latitude_deg, "latitude_deg") = where.latitude_deg;
    longitude = where.longitude_deg;
  });
}

geoloc_status geoloc_to_local(const geoloc_geolocator* geolocator, double latitude_deg, double longitude_deg,
                              double* east_m, double* north_m) {
  return in_local_frame(geolocator, [&](const geoloc::LocalFrame& frame) {
    const geoloc::Geodetic where{latitude_deg, longitude_deg};
    if (!geoloc::is_valid(where)) throw BadArgument("latitude_deg and longitude_deg are no place on Earth");
    double& north = required(north_m, "north_m");
    const geoloc::LocalPoint point = frame.to_local(where);
    required(east_m, "east_m") = point.position_in_enu.x();
    north = point.position_in_enu.y();
  });
}
}
