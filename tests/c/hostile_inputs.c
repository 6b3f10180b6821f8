/* SPDX-License-Identifier: Apache-2.0
 * What no caller should give, in C99: each is answered by an error code and a reason, and changes nothing. */
#include <geoloc/geoloc.h>

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "expect.h"

static void refuse_null(geoloc_config *config, geoloc_geolocator *geolocator) {
  const geoloc_camera camera = geoloc_camera_from_field_of_view(1280, 720, 70.0);
  const geoloc_attitude attitude = {0};
  const geoloc_position position = {0};
  const geoloc_gimbal gimbal = {0};
  const geoloc_field_of_view field_of_view = {0};
  const geoloc_range range = {0};
  const geoloc_frame frame = {0};
  geoloc_frame boxless = {0};
  geoloc_outcome outcome;
  geoloc_object object;
  geoloc_fix fix;
  geoloc_pose pose;
  geoloc_calibration calibration;
  geoloc_counters counters;
  geoloc_geolocator *created = NULL;
  size_t count = 0;
  double a = 0.0, b = 0.0;

  geoloc_config_destroy(NULL);
  geoloc_destroy(NULL);
  EXPECT_INVALID(geoloc_config_set_number(NULL, "joint.gate", 1.0), "config");
  EXPECT_INVALID(geoloc_config_set_number(config, NULL, 1.0), "path");
  EXPECT_INVALID(geoloc_config_set_text(config, "method", NULL), "value");
  EXPECT_INVALID(geoloc_config_set_text(NULL, "method", "joint"), "config");
  EXPECT_INVALID(geoloc_config_set_numbers(config, "joint.moving.classes", NULL, 3), "values");
  EXPECT_INVALID(geoloc_config_set_numbers(NULL, "joint.moving.classes", &a, 1), "config");
  EXPECT_INVALID(geoloc_config_set_camera(NULL, &camera), "config");
  EXPECT_INVALID(geoloc_config_set_camera(config, NULL), "camera");
  EXPECT_INVALID(geoloc_config_set_terrain(config, NULL), "grid");
  EXPECT_INVALID(geoloc_create(NULL, &created), "config");
  EXPECT_INVALID(geoloc_create(config, NULL), "geolocator");
  size_t bytes = 1;
  EXPECT_INVALID(geoloc_memory_needed(NULL, &bytes), "config");
  EXPECT_INVALID(geoloc_memory_needed(config, NULL), "bytes");
  EXPECT_INVALID(geoloc_add_attitude(NULL, &attitude), "geolocator");
  EXPECT_INVALID(geoloc_add_attitude(geolocator, NULL), "attitude");
  EXPECT_INVALID(geoloc_add_position(NULL, &position), "geolocator");
  EXPECT_INVALID(geoloc_add_position(geolocator, NULL), "position");
  EXPECT_INVALID(geoloc_add_gimbal(NULL, &gimbal), "geolocator");
  EXPECT_INVALID(geoloc_add_gimbal(geolocator, NULL), "gimbal");
  EXPECT_INVALID(geoloc_add_field_of_view(NULL, &field_of_view), "geolocator");
  EXPECT_INVALID(geoloc_add_field_of_view(geolocator, NULL), "field_of_view");
  EXPECT_INVALID(geoloc_add_range(NULL, &range), "geolocator");
  EXPECT_INVALID(geoloc_add_range(geolocator, NULL), "range");
  EXPECT_INVALID(geoloc_add_frame(NULL, &frame, NULL), "geolocator");
  EXPECT_INVALID(geoloc_add_frame(geolocator, NULL, NULL), "frame");
  boxless.detection_count = 1;
  EXPECT_INVALID(geoloc_add_frame(geolocator, &boxless, NULL), "frame.detections");
  EXPECT_INVALID(geoloc_process_next(NULL, 0, &outcome), "geolocator");
  EXPECT_INVALID(geoloc_process_next(geolocator, 0, NULL), "outcome");
  EXPECT_INVALID(geoloc_finish(NULL), "geolocator");
  EXPECT_INVALID(geoloc_on_vehicle_reboot(NULL), "geolocator");
  EXPECT_INVALID(geoloc_on_vehicle_clock_step(NULL), "geolocator");
  EXPECT_INVALID(geoloc_objects(NULL, &object, 1, &count), "geolocator");
  EXPECT_INVALID(geoloc_objects(geolocator, NULL, 1, &count), "array");
  EXPECT_INVALID(geoloc_objects(geolocator, &object, 1, NULL), "count");
  EXPECT_INVALID(geoloc_fixes(NULL, &fix, 1, &count), "geolocator");
  EXPECT_INVALID(geoloc_fixes(geolocator, &fix, 1, NULL), "count");
  EXPECT_INVALID(geoloc_camera_pose(NULL, &pose), "geolocator");
  EXPECT_INVALID(geoloc_camera_pose(geolocator, NULL), "pose");
  EXPECT_INVALID(geoloc_calibration_of(NULL, &calibration), "geolocator");
  EXPECT_INVALID(geoloc_calibration_of(geolocator, NULL), "calibration");
  EXPECT_INVALID(geoloc_counters_of(NULL, &counters), "geolocator");
  EXPECT_INVALID(geoloc_counters_of(geolocator, NULL), "counters");
  EXPECT_INVALID(geoloc_to_geodetic(NULL, 0.0, 0.0, &a, &b), "geolocator");
  EXPECT_INVALID(geoloc_to_local(NULL, 0.0, 0.0, &a, &b), "geolocator");
}

/* Every number of a sample, one after the other, as no number and as infinity. `first` is the first of `count` doubles. */
#define REFUSE_EACH(structure, first, count, add, name)        \
  do {                                                         \
    double *const numbers = (first);                           \
    for (size_t i = 0; i < (count); ++i) {                     \
      const double before = numbers[i];                        \
      numbers[i] = (double)NAN;                                \
      EXPECT_INVALID(add(geolocator, &(structure)), name);     \
      numbers[i] = -(double)INFINITY;                          \
      EXPECT_INVALID(add(geolocator, &(structure)), name);     \
      numbers[i] = before;                                     \
    }                                                          \
  } while (0)

static void refuse_no_numbers(geoloc_geolocator *geolocator) {
  geoloc_attitude attitude = {0};
  geoloc_position position = {0};
  geoloc_gimbal gimbal = {0};
  geoloc_field_of_view field_of_view = {0};
  geoloc_range range = {0};
  geoloc_detection box = {10.0, 10.0, 20.0, 20.0, 0.9, 0, 0.0};
  geoloc_frame frame = {0};

  attitude.has_rates = 1;
  REFUSE_EACH(attitude, &attitude.roll_rad, 6, geoloc_add_attitude, "attitude.");
  position.has_height_msl = position.has_velocity = 1;
  REFUSE_EACH(position, &position.latitude_deg, 8, geoloc_add_position, "position.");
  REFUSE_EACH(gimbal, gimbal.level_from_gimbal_wxyz, 4, geoloc_add_gimbal, "gimbal.");
  REFUSE_EACH(field_of_view, &field_of_view.horizontal_rad, 2, geoloc_add_field_of_view, "field_of_view.");
  REFUSE_EACH(range, &range.distance_m, 1, geoloc_add_range, "range.");

  frame.detections = &box;
  frame.detection_count = 1;
  for (size_t i = 0; i < 5; ++i) {
    double *const numbers = &box.x_px;
    const double before = numbers[i];
    numbers[i] = (double)NAN;
    EXPECT_INVALID(geoloc_add_frame(geolocator, &frame, NULL), "detection.");
    numbers[i] = before;
  }
  frame.time_sigma_s = (double)NAN;
  EXPECT_INVALID(geoloc_add_frame(geolocator, &frame, NULL), "time_sigma_s");
  frame.time_sigma_s = 1e300;
  EXPECT_INVALID(geoloc_add_frame(geolocator, &frame, NULL), "time_sigma_s");
  frame.time_sigma_s = 0.0;
  frame.focal_px[1] = (double)NAN;
  EXPECT_INVALID(geoloc_add_frame(geolocator, &frame, NULL), "focal_px");
}

static void refuse_what_cannot_be(geoloc_geolocator *geolocator) {
  geoloc_attitude attitude = {0};
  geoloc_position position = {0};
  geoloc_gimbal gimbal = {0};
  geoloc_frame frame = {0};
  geoloc_outcome outcome;

  attitude.roll_rad = 90.0; /* degrees */
  EXPECT_INVALID(geoloc_add_attitude(geolocator, &attitude), "radians");
  attitude.roll_rad = 0.0;
  attitude.time_ns = INT64_MIN;
  EXPECT_INVALID(geoloc_add_attitude(geolocator, &attitude), "attitude.time_ns");
  position.latitude_deg = 91.0;
  EXPECT_INVALID(geoloc_add_position(geolocator, &position), "no place on Earth");
  position.latitude_deg = 0.0;
  position.time_ns = INT64_MAX;
  EXPECT_INVALID(geoloc_add_position(geolocator, &position), "position.time_ns");
  EXPECT_INVALID(geoloc_add_gimbal(geolocator, &gimbal), "no rotation");
  gimbal.level_from_gimbal_wxyz[0] = 1.0;
  gimbal.yaw = 2;
  EXPECT_INVALID(geoloc_add_gimbal(geolocator, &gimbal), "gimbal.yaw");
  frame.detection_count = SIZE_MAX;
  EXPECT_INVALID(geoloc_add_frame(geolocator, &frame, NULL), "detection_count");
  frame.detection_count = 0;
  frame.captured_at_utc_ns = INT64_MIN;
  EXPECT_INVALID(geoloc_add_frame(geolocator, &frame, NULL), "captured_at_utc_ns");
  frame.captured_at_utc_ns = 0;
  frame.has_mount = 1;
  frame.mount.kind = -7;
  EXPECT_INVALID(geoloc_add_frame(geolocator, &frame, NULL), "mount.kind");
  EXPECT_INVALID(geoloc_process_next(geolocator, 2, &outcome), "wait");
  EXPECT(strcmp(geoloc_explain(-1), geoloc_explain(GEOLOC_FATES)) == 0);
  EXPECT(strlen(geoloc_explain(GEOLOC_IN_A_GAP)) > 10);
}

static void refuse_settings(geoloc_config *config) {
  geoloc_camera camera = geoloc_camera_from_field_of_view(-5, 0, (double)NAN);
  geoloc_height_grid grid = {0};
  geoloc_geolocator *created = NULL;
  const float height_m = 3.0f;
  const double no_number = (double)NAN;

  EXPECT_NO_SETTING(geoloc_config_set_number(config, "", 1.0), "is not a setting");
  EXPECT_NO_SETTING(geoloc_config_set_number(config, "joint", 1.0), "joint is not a setting");
  EXPECT_NO_SETTING(geoloc_config_set_number(config, "joint.gat", 1.0), "joint.gat is not a setting");
  EXPECT_NO_SETTING(geoloc_config_set_number(config, "joint.gate", no_number), "joint.gate must be a finite number");
  EXPECT_NO_SETTING(geoloc_config_set_number(config, "joint.max_tracks", 1.5), "whole number, but is 1.5");
  EXPECT_NO_SETTING(geoloc_config_set_number(config, "joint.max_tracks", 1e300), "whole number");
  EXPECT_NO_SETTING(geoloc_config_set_number(config, "method", 1.0), "method must be a text");
  EXPECT_NO_SETTING(geoloc_config_set_text(config, "method", "best"), "must be one of: paper, joint");
  EXPECT_NO_SETTING(geoloc_config_set_text(config, "joint.gate", "1"), "finite number");
  EXPECT_NO_SETTING(geoloc_config_set_numbers(config, "camera.distortion", &no_number, 1), "finite numbers");
  EXPECT_NO_SETTING(geoloc_config_set_number(config, "known_points[7].sigma_m", 1.0), "the next one is 0");
  EXPECT_NO_SETTING(geoloc_config_set_number(config, "known_points[-1].sigma_m", 1.0), "is not a setting");
  EXPECT_NO_SETTING(geoloc_config_set_number(config, "known_points[99999999999999999999].sigma_m", 1.0), "is not a setting");
  EXPECT_INVALID(geoloc_config_set_numbers(config, "joint.moving.classes", &no_number, SIZE_MAX), "more than");
  camera.mount.kind = 3;
  EXPECT_INVALID(geoloc_config_set_camera(config, &camera), "mount.kind");
  grid.rows = SIZE_MAX / 2;
  grid.columns = 4;
  grid.heights_m = &height_m;
  EXPECT_INVALID(geoloc_config_set_terrain(config, &grid), "heights");
  grid.rows = grid.columns = 1;
  EXPECT_INVALID(geoloc_config_set_terrain(config, &grid), "");

  /* All faults of values at once, and no estimator. */
  EXPECT(geoloc_config_set_number(config, "joint.gate", -1.0) == GEOLOC_OK);
  EXPECT(geoloc_config_set_number(config, "max_detections", 1e9) == GEOLOC_OK);
  size_t bytes = 1;
  EXPECT_NO_SETTING(geoloc_memory_needed(config, &bytes), "max_detections must lie in [1, 10000], but is 1000000000");
  EXPECT(bytes == 0);
  EXPECT_NO_SETTING(geoloc_create(config, &created), "max_detections must lie in [1, 10000], but is 1000000000");
  EXPECT(strstr(geoloc_last_error(), "joint.gate must lie in (0, 1000], but is -1") != NULL);
  EXPECT(created == NULL);
}

int main(void) {
  geoloc_config *const config = geoloc_config_create();
  geoloc_geolocator *geolocator = NULL;
  geoloc_counters counters;
  double a = 0.0, b = 0.0;
  geoloc_pose pose;

  EXPECT(strcmp(geoloc_last_error(), "") == 0);
  EXPECT(strlen(geoloc_version()) >= 5);
  EXPECT(geoloc_create(config, &geolocator) == GEOLOC_OK);
  refuse_null(config, geolocator);
  refuse_no_numbers(geolocator);
  refuse_what_cannot_be(geolocator);
  refuse_settings(config);

  EXPECT(geoloc_counters_of(geolocator, &counters) == GEOLOC_OK);
  EXPECT(counters.attitudes == 0 && counters.positions == 0 && counters.frames_waiting == 0);
  EXPECT(counters.out_of_range == 1);
  EXPECT(geoloc_to_geodetic(geolocator, 0.0, 0.0, &a, &b) == GEOLOC_NOTHING);
  EXPECT(geoloc_camera_pose(geolocator, &pose) == GEOLOC_NOTHING);
  geoloc_destroy(geolocator);
  geoloc_config_destroy(config);
  return failures == 0 ? 0 : 1;
}
