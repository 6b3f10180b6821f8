/* SPDX-License-Identifier: Apache-2.0
 * estimate FEED: the calls of tests/languages/feed.py through the library for C. */
#include <geoloc/geoloc.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOST_DETECTIONS 1000

static void check(geoloc_status status) {
  if (status >= 0) return;
  fprintf(stderr, "%s\n", geoloc_last_error());
  exit(1);
}

static void read_doubles(FILE* feed, double* values, int count) {
  for (int i = 0; i < count; ++i) {
    uint64_t bits = 0;
    if (fscanf(feed, " %16" SCNx64, &bits) != 1) exit(2);
    memcpy(values + i, &bits, sizeof bits);
  }
}

static int64_t read_whole(FILE* feed) {
  int64_t value = 0;
  if (fscanf(feed, " %" SCNd64, &value) != 1) exit(2);
  return value;
}

static void print_doubles(const double* values, int count) {
  for (int i = 0; i < count; ++i) {
    uint64_t bits = 0;
    memcpy(&bits, values + i, sizeof bits);
    printf(" %016" PRIx64, bits);
  }
}

static geoloc_geolocator* read_geolocator(FILE* feed) {
  double numbers[15];
  geoloc_camera camera = {0};
  camera.width_px = (int32_t)read_whole(feed);
  camera.height_px = (int32_t)read_whole(feed);
  read_doubles(feed, numbers, 15);
  camera.fx_px = numbers[0];
  camera.fy_px = numbers[1];
  camera.cx_px = numbers[2];
  camera.cy_px = numbers[3];
  memcpy(camera.distortion, numbers + 4, sizeof camera.distortion);
  camera.mount.roll_deg = numbers[9];
  camera.mount.pitch_deg = numbers[10];
  camera.mount.yaw_deg = numbers[11];
  camera.mount.x_m = numbers[12];
  camera.mount.y_m = numbers[13];
  camera.mount.z_m = numbers[14];
  geoloc_config* config = geoloc_config_create();
  check(geoloc_config_set_camera(config, &camera));
  geoloc_geolocator* geolocator = NULL;
  check(geoloc_create(config, &geolocator));
  geoloc_config_destroy(config);
  return geolocator;
}

static void read_attitude(FILE* feed, geoloc_geolocator* geolocator) {
  geoloc_attitude attitude = {0};
  double numbers[6];
  attitude.time_ns = read_whole(feed);
  read_doubles(feed, numbers, 6);
  attitude.roll_rad = numbers[0];
  attitude.pitch_rad = numbers[1];
  attitude.yaw_rad = numbers[2];
  memcpy(attitude.rates_in_body_radps, numbers + 3, sizeof attitude.rates_in_body_radps);
  attitude.has_rates = 1;
  check(geoloc_add_attitude(geolocator, &attitude));
}

static void read_position(FILE* feed, geoloc_geolocator* geolocator) {
  geoloc_position position = {0};
  double numbers[4];
  position.time_ns = read_whole(feed);
  read_doubles(feed, numbers, 4);
  position.latitude_deg = numbers[0];
  position.longitude_deg = numbers[1];
  position.height_above_home_m = numbers[2];
  position.height_msl_m = numbers[3];
  position.has_height_msl = 1;
  check(geoloc_add_position(geolocator, &position));
}

static void read_frame(FILE* feed, geoloc_geolocator* geolocator) {
  static geoloc_detection seen[MOST_DETECTIONS];
  geoloc_frame frame = {0};
  frame.captured_at_ns = read_whole(feed);
  frame.captured_at_utc_ns = read_whole(feed);
  frame.detection_count = (size_t)read_whole(feed);
  if (frame.detection_count > MOST_DETECTIONS) exit(2);
  memset(seen, 0, sizeof seen);
  for (size_t i = 0; i < frame.detection_count; ++i) {
    double numbers[5];
    char kind = 0;
    if (fscanf(feed, " %c", &kind) != 1 || kind != 'D') exit(2);
    seen[i].class_id = (int32_t)read_whole(feed);
    read_doubles(feed, numbers, 5);
    seen[i].x_px = numbers[0];
    seen[i].y_px = numbers[1];
    seen[i].width_px = numbers[2];
    seen[i].height_px = numbers[3];
    seen[i].confidence = numbers[4];
  }
  frame.detections = seen;
  check(geoloc_add_frame(geolocator, &frame, NULL));
}

static void process(geoloc_geolocator* geolocator, geoloc_wait wait) {
  geoloc_outcome outcome;
  while (geoloc_process_next(geolocator, (int32_t)wait, &outcome) == GEOLOC_OK) {
    printf("F %" PRId64 " %" PRId32 "\n", outcome.captured_at_ns, outcome.fate);
  }
}

static void print_object(const geoloc_object* object) {
  const double numbers[10] = {object->latitude_deg,     object->longitude_deg,       object->east_m,
                              object->north_m,          object->covariance_m2[0],    object->covariance_m2[1],
                              object->covariance_m2[2], object->height_above_home_m, object->sigma_height_m,
                              object->confidence};
  printf("O %" PRIu64 " %" PRId32 " %" PRId32 " %" PRId64 " %" PRId64, object->id, object->class_id,
         object->hits, object->first_seen_utc_ns, object->last_seen_utc_ns);
  print_doubles(numbers, 10);
  printf("\n");
}

int main(int argc, char** argv) {
  FILE* feed = argc == 2 ? fopen(argv[1], "r") : NULL;
  if (!feed) return 2;
  geoloc_geolocator* geolocator = NULL;
  for (char kind = 0; fscanf(feed, " %c", &kind) == 1;) {
    switch (kind) {
      case 'C':
        geolocator = read_geolocator(feed);
        break;
      case 'A':
        read_attitude(feed, geolocator);
        break;
      case 'P':
        read_position(feed, geolocator);
        break;
      case 'F':
        read_frame(feed, geolocator);
        break;
      default:
        return 2;
    }
    process(geolocator, GEOLOC_WAIT_FOR_TELEMETRY);
  }
  fclose(feed);
  process(geolocator, GEOLOC_WAIT_NO_LONGER);
  check(geoloc_finish(geolocator));
  size_t count = 0;
  check(geoloc_objects(geolocator, NULL, 0, &count));
  geoloc_object* objects = malloc((count + 1) * sizeof *objects);
  if (!objects) return 1;
  check(geoloc_objects(geolocator, objects, count, &count));
  for (size_t i = 0; i < count; ++i) print_object(objects + i);
  free(objects);
  geoloc_destroy(geolocator);
  return 0;
}
