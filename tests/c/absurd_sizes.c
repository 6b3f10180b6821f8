/* SPDX-License-Identifier: Apache-2.0
 * A flight of numbers that are finite and that nothing has, in C99. */
#include <geoloc/geoloc.h>

#include <math.h>
#include <stdint.h>

#include "expect.h"

/* Whatever becomes of it, each frame is told of, and results are numbers. */
static void survive_absurd_sizes(geoloc_config *config) {
  static const double sizes[] = {-1.7e308, -1e150, -1e19, 0.0, 1e19, 1e150, 1.7e308};
  const int64_t step_ns = 100000000;
  geoloc_geolocator *geolocator = NULL;
  geoloc_counters counters;
  geoloc_outcome outcome;
  geoloc_object objects[64];
  size_t count = 0;
  EXPECT(geoloc_create(config, &geolocator) == GEOLOC_OK);
  for (size_t i = 0; i < 3 * 7 * 7; ++i) {
    const double size = sizes[i % 7], other = sizes[i / 7 % 7];
    geoloc_attitude attitude = {0};
    geoloc_position position = {0};
    geoloc_range range = {0};
    geoloc_field_of_view field_of_view = {0};
    geoloc_detection box = {600.0, 300.0, 30.0, 30.0, 0.9, 0, 0.0};
    geoloc_frame frame = {0};
    attitude.time_ns = position.time_ns = range.time_ns = field_of_view.time_ns = (int64_t)i * step_ns;
    attitude.has_rates = position.has_height_msl = position.has_velocity = i % 2;
    attitude.rates_in_body_radps[i % 3] = size;
    position.height_above_home_m = i % 3 == 1 ? size : 20.0;
    position.height_msl_m = other;
    position.sigma_horizontal_m = fabs(size);
    position.velocity_in_enu_mps[i % 3] = other;
    range.distance_m = fabs(size);
    field_of_view.horizontal_rad = fabs(other);
    if (i % 3 == 2) {
      box.x_px = size;
      box.height_px = other;
      box.class_id = INT32_MIN;
      box.sigma_px = size;
    }
    frame.captured_at_ns = (int64_t)i * step_ns - step_ns / 2;
    frame.captured_at_utc_ns = i % 7 == 0 ? -4000000000000000000 : 4000000000000000000;
    frame.detections = &box;
    frame.detection_count = 1;
    if (i % 5 == 0) frame.focal_px[0] = frame.focal_px[1] = size;
    EXPECT(geoloc_add_attitude(geolocator, &attitude) == GEOLOC_OK);
    EXPECT(geoloc_add_position(geolocator, &position) <= GEOLOC_OK);
    EXPECT(geoloc_add_range(geolocator, &range) == GEOLOC_OK);
    EXPECT(geoloc_add_field_of_view(geolocator, &field_of_view) == GEOLOC_OK);
    EXPECT(geoloc_add_frame(geolocator, &frame, NULL) >= GEOLOC_OK);
    while (geoloc_process_next(geolocator, GEOLOC_WAIT_FOR_TELEMETRY, &outcome) == GEOLOC_OK)
      EXPECT(outcome.fate >= 0 && outcome.fate < GEOLOC_FATES);
  }
  EXPECT(geoloc_finish(geolocator) == GEOLOC_OK);
  EXPECT(geoloc_counters_of(geolocator, &counters) == GEOLOC_OK);
  EXPECT(counters.frames == 3 * 7 * 7 && counters.frames_waiting == 0);
  EXPECT(counters.frames_by_fate[GEOLOC_LOCATED] > 10 && counters.frames_by_fate[GEOLOC_LOCATED] < 3 * 7 * 7);
  EXPECT(geoloc_objects(geolocator, objects, 64, &count) == GEOLOC_OK);
  for (size_t i = 0; i < count && i < 64; ++i) EXPECT(isfinite(objects[i].latitude_deg) && isfinite(objects[i].longitude_deg));
  geoloc_destroy(geolocator);
}

int main(void) {
  geoloc_config *const config = geoloc_config_create();
  survive_absurd_sizes(config);
  geoloc_config_destroy(config);
  return failures == 0 ? 0 : 1;
}
