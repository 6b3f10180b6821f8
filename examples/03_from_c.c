/* SPDX-License-Identifier: Apache-2.0
 * A C program that links libgeoloc_c: telemetry and a detector's boxes in, geographic coordinates out. */
#include <geoloc/geoloc.h>

#include <inttypes.h>
#include <math.h>
#include <stdio.h>

/* A straight flight to the north at 5 m/s and 20 m, over an object that lies 30 m ahead and 3 m to the right. */
static const double kSpeed_mps = 5.0, kHeight_m = 20.0, kObjectNorth_m = 30.0, kObjectEast_m = 3.0;
static const double kDegPerMetreNorth = 1.0 / 111175.0; /* there */
static const int64_t kMs = 1000000;

static double north_m(int64_t time_ns) { return kSpeed_mps * 1e-9 * (double)time_ns; }

static geoloc_status add_telemetry(geoloc_geolocator *geolocator, int64_t now_ns) {
  geoloc_attitude attitude = {0}; /* level, to the north */
  attitude.time_ns = now_ns;
  geoloc_position position = {0};
  position.time_ns = now_ns;
  position.latitude_deg = 47.3977 + kDegPerMetreNorth * north_m(now_ns);
  position.longitude_deg = 8.5456;
  position.height_above_home_m = kHeight_m;
  const geoloc_status status = geoloc_add_attitude(geolocator, &attitude);
  return status < 0 ? status : geoloc_add_position(geolocator, &position);
}

/* The box that a detector finds while the object is in the picture of a camera that looks straight down. */
static geoloc_status add_picture(geoloc_geolocator *geolocator, int64_t captured_at_ns, const geoloc_camera *camera) {
  const double ahead_m = kObjectNorth_m - north_m(captured_at_ns);
  geoloc_detection box = {0};
  box.width_px = box.height_px = 36.0;
  box.x_px = 640.0 + camera->fx_px * kObjectEast_m / kHeight_m - 18.0;
  box.y_px = 360.0 - camera->fy_px * ahead_m / kHeight_m - 18.0;
  box.confidence = 0.9;
  geoloc_frame frame = {0};
  frame.captured_at_ns = captured_at_ns;
  frame.detections = &box;
  frame.detection_count = fabs(ahead_m) > 7.0 ? 0 : 1; /* that nothing was found is information, too */
  return geoloc_add_frame(geolocator, &frame, NULL);
}

static geoloc_status fly(geoloc_geolocator *geolocator, const geoloc_camera *camera) {
  for (int64_t now_ns = 0; now_ns <= 10000 * kMs; now_ns += 50 * kMs) {
    geoloc_status status = GEOLOC_OK;
    if (now_ns % (100 * kMs) == 0) status = add_telemetry(geolocator, now_ns); /* at 10 Hz */
    if (now_ns % (100 * kMs) == 50 * kMs && now_ns > 150 * kMs)
      status = add_picture(geolocator, now_ns - 100 * kMs, camera); /* the detector takes 0.1 s for each picture */
    if (status < 0) return status;

    geoloc_outcome frame;
    while ((status = geoloc_process_next(geolocator, GEOLOC_WAIT_FOR_TELEMETRY, &frame)) == GEOLOC_OK) {
      if (frame.fate != GEOLOC_LOCATED) printf("%s\n", geoloc_explain(frame.fate));
    }
    if (status < 0) return status;
  }
  return geoloc_finish(geolocator);
}

/* How many objects there are. */
static size_t print_objects(const geoloc_geolocator *geolocator) {
  geoloc_object objects[10];
  size_t count = 0;
  if (geoloc_objects(geolocator, objects, 10, &count) < 0) return 0;
  for (size_t i = 0; i < count && i < 10; ++i) {
    printf("object %" PRIu64 ": %.7f, %.7f from %d looks\n", objects[i].id, objects[i].latitude_deg, objects[i].longitude_deg,
           (int)objects[i].hits);
  }
  return count;
}

int main(void) {
  const geoloc_camera camera = geoloc_camera_from_field_of_view(1280, 720, 70.0); /* it looks straight down */
  geoloc_config *config = geoloc_config_create();
  geoloc_geolocator *geolocator = NULL;
  size_t found = 0;

  if (geoloc_config_set_camera(config, &camera) < 0 ||
      geoloc_config_set_number(config, "joint.max_tracks", 100) < 0 || /* any setting of docs/settings.md */
      geoloc_create(config, &geolocator) < 0 || fly(geolocator, &camera) < 0) {
    fprintf(stderr, "%s\n", geoloc_last_error());
  } else {
    found = print_objects(geolocator);
  }
  geoloc_destroy(geolocator);
  geoloc_config_destroy(config);
  return found == 1 ? 0 : 1;
}
