/* SPDX-License-Identifier: Apache-2.0 */
#ifndef GEOLOC_GEOLOC_H
#define GEOLOC_GEOLOC_H

/* The estimator in C99: libgeoloc_c.so. docs/library.md tells what becomes of frames, what clocks, frames of reference, pixels and
 * heights are meant, and what is C's own. No function throws, prints, reads a clock or opens a file. A call that fails
 * changes nothing but counters, and geoloc_last_error() tells why. A structure that begins as {0} states nothing that is optional. */

#include <stddef.h>
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif
/* NOLINTBEGIN(readability-identifier-naming): names as C has them */

/* What a function answers: 0 or more, it has worked; less than 0, it has not. */
typedef enum geoloc_status {
  GEOLOC_OK = 0,
  GEOLOC_NOTHING = 1,           /* there is none: no frame is ready, no position has come, the method learns no calibration */
  GEOLOC_FRAME_GIVEN_UP = 2,    /* the frame was added, and one that waited had to go for it, or it had to go itself */
  GEOLOC_INVALID_ARGUMENT = -1, /* NULL, not a finite number, out of range, too many */
  GEOLOC_INVALID_SETTING = -2,  /* unknown settings, and values that they cannot have */
  GEOLOC_OUT_OF_MEMORY = -3,
  GEOLOC_INTERNAL_ERROR = -4
} geoloc_status;

/* Why the last function that failed in this thread did so; "" before any. It holds until the next failure in the thread. */
const char *geoloc_last_error(void);

/* "0.1.0" */
const char *geoloc_version(void);

/* ---- Configuration: every setting of docs/settings.md that is the estimator's, by its path there ---- */

typedef struct geoloc_config geoloc_config;
geoloc_config *geoloc_config_create(void); /* all defaults; NULL where there is no memory */
void geoloc_config_destroy(geoloc_config *config); /* NULL does nothing */

/* "joint.max_tracks", 100; of a setting that is true or false, 1 or 0. Entries of a list are named "known_points[0].latitude_deg";
 * the one past the last begins a new one. Ranges are checked by geoloc_create(). */
geoloc_status geoloc_config_set_number(geoloc_config *config, const char *path, double value);
/* "method", "paper" */
geoloc_status geoloc_config_set_text(geoloc_config *config, const char *path, const char *value);
/* "joint.moving.classes", "camera.distortion" */
geoloc_status geoloc_config_set_numbers(geoloc_config *config, const char *path, const double *values, size_t count);

typedef enum geoloc_mount_kind { GEOLOC_MOUNT_FIXED = 0, GEOLOC_MOUNT_GIMBAL = 1 } geoloc_mount_kind;

/* The camera in the body, or on its gimbal: pitch_deg -90 looks straight down from a body, 0 where a gimbal says. */
typedef struct geoloc_mount {
  double roll_deg, pitch_deg, yaw_deg; /* applied yaw, pitch, roll */
  double x_m, y_m, z_m;                /* lever arm in the body: forward, right, down */
  int32_t kind;                        /* geoloc_mount_kind */
} geoloc_mount;

/* OpenCV's conventions: pixel centres at integers. */
typedef struct geoloc_camera {
  int32_t width_px, height_px;
  double fx_px, fy_px, cx_px, cy_px;
  double distortion[5]; /* k1 k2 p1 p2 k3 */
  geoloc_mount mount;
} geoloc_camera;

/* Square pixels, no distortion, looking straight down. The field of view spans the image's outer edges. */
geoloc_camera geoloc_camera_from_field_of_view(int32_t width_px, int32_t height_px, double horizontal_fov_deg);
geoloc_status geoloc_config_set_camera(geoloc_config *config, const geoloc_camera *camera);

/* Heights of the ground [m] above any level, NaN where unknown: rows from south to north, columns from west to east. */
typedef struct geoloc_height_grid {
  double south_deg, west_deg; /* of the first row and column, WGS84 */
  double latitude_step_deg, longitude_step_deg;
  size_t rows, columns;
  const float *heights_m; /* rows * columns; copied */
} geoloc_height_grid;
geoloc_status geoloc_config_set_terrain(geoloc_config *config, const geoloc_height_grid *grid);

/* ---- The estimator ---- */

typedef struct geoloc_geolocator geoloc_geolocator; /* one thread at a time calls it */
/* What geoloc_create() will ask of the heap, without what the heap adds of its own; fails as that does. Takes none of it. */
geoloc_status geoloc_memory_needed(const geoloc_config *config, size_t *bytes);
/* Takes all its memory. GEOLOC_INVALID_SETTING: geoloc_last_error() names every fault. The configuration may be destroyed. */
geoloc_status geoloc_create(const geoloc_config *config, geoloc_geolocator **geolocator);
void geoloc_destroy(geoloc_geolocator *geolocator); /* NULL does nothing */

/* Times are nanoseconds of the vehicle's clock, within +-4e18. A sample that cannot be one is GEOLOC_INVALID_ARGUMENT; one that comes
 * twice or too late is counted (geoloc_counters). */
typedef struct geoloc_attitude {
  int64_t time_ns;
  double roll_rad, pitch_rad, yaw_rad; /* of the body (forward, right, down), yaw from true north, clockwise */
  double rates_in_body_radps[3];       /* where has_rates */
  uint8_t has_rates;
} geoloc_attitude;
geoloc_status geoloc_add_attitude(geoloc_geolocator *geolocator, const geoloc_attitude *attitude);

typedef struct geoloc_position {
  int64_t time_ns;
  double latitude_deg, longitude_deg; /* WGS84 */
  double height_above_home_m;
  double height_msl_m;           /* where has_height_msl */
  double sigma_horizontal_m;     /* 1-sigma that the receiver claims; 0: none */
  double velocity_in_enu_mps[3]; /* east, north, up, where has_velocity */
  uint8_t has_height_msl, has_velocity;
} geoloc_position;
geoloc_status geoloc_add_position(geoloc_geolocator *geolocator, const geoloc_position *position);

typedef enum geoloc_gimbal_yaw { GEOLOC_YAW_FROM_NOSE = 0, GEOLOC_YAW_FROM_NORTH = 1 } geoloc_gimbal_yaw;

typedef struct geoloc_gimbal {
  int64_t time_ns;
  double level_from_gimbal_wxyz[4]; /* from forward, right, down to level axes: x to nose or north, z down */
  int32_t yaw;                      /* geoloc_gimbal_yaw: what its yaw counts from */
  uint8_t tells_hold, holds_direction; /* whether it tells that it holds a direction over ground; and that it does */
} geoloc_gimbal;
geoloc_status geoloc_add_gimbal(geoloc_geolocator *geolocator, const geoloc_gimbal *gimbal);

typedef struct geoloc_field_of_view {
  int64_t time_ns;
  double horizontal_rad, vertical_rad; /* between the image's edges; 0: not told */
} geoloc_field_of_view;
geoloc_status geoloc_add_field_of_view(geoloc_geolocator *geolocator, const geoloc_field_of_view *field_of_view);

typedef struct geoloc_range {
  int64_t time_ns;
  double distance_m; /* that a rangefinder measures down the body's axis */
} geoloc_range;
geoloc_status geoloc_add_range(geoloc_geolocator *geolocator, const geoloc_range *range);

/* In pixels of the full image, in continuous coordinates: the image's left edge is x = 0. */
typedef struct geoloc_detection {
  double x_px, y_px, width_px, height_px; /* x, y: the top left corner */
  double confidence;                      /* 0..1 */
  int32_t class_id;
  double sigma_px; /* 1-sigma of the box's centre per axis; 0: not stated */
} geoloc_detection;

#define GEOLOC_MOST_DETECTIONS 100000

typedef struct geoloc_frame {
  int64_t captured_at_ns;             /* middle of the exposure, on the vehicle's clock */
  int64_t captured_at_utc_ns;         /* the same since the UNIX epoch; 0: captured_at_ns stands for it */
  double time_sigma_s;                /* 1-sigma of captured_at_ns; 0: not stated */
  const geoloc_detection *detections; /* may be NULL where there are none: that is information, too */
  size_t detection_count;             /* at most GEOLOC_MOST_DETECTIONS */
  double focal_px[2];                 /* fx, fy of a camera that zooms; 0, 0: the calibration's */
  geoloc_mount mount;                 /* then, where has_mount */
  uint8_t has_mount;
} geoloc_frame;

/* What became of a frame; geoloc_explain() tells it in a sentence. */
typedef enum geoloc_fate {
  GEOLOC_LOCATED = 0,
  GEOLOC_NO_TELEMETRY = 1,
  GEOLOC_BEFORE_TELEMETRY = 2,
  GEOLOC_IN_A_GAP = 3,
  GEOLOC_AFTER_TELEMETRY = 4,
  GEOLOC_OUT_OF_ORDER = 5,
  GEOLOC_CLOCK_BEGUN_ANEW = 6,
  GEOLOC_NO_ROOM = 7,
  GEOLOC_UNUSABLE_MOUNT = 8,
  GEOLOC_NO_GIMBAL = 9,
  GEOLOC_UNUSABLE_FOCAL_LENGTH = 10
} geoloc_fate;
#define GEOLOC_FATES 11
const char *geoloc_explain(int32_t fate);

typedef struct geoloc_outcome {
  int64_t captured_at_ns, captured_at_utc_ns;
  int32_t fate; /* geoloc_fate */
} geoloc_outcome;

/* At most 64 frames wait: beyond, GEOLOC_FRAME_GIVEN_UP, and `given_up`, which may be NULL, is the one that went. */
geoloc_status geoloc_add_frame(geoloc_geolocator *geolocator, const geoloc_frame *frame, geoloc_outcome *given_up);

typedef enum geoloc_wait { GEOLOC_WAIT_FOR_TELEMETRY = 0, GEOLOC_WAIT_NO_LONGER = 1 } geoloc_wait;

/* To be called until it answers GEOLOC_NOTHING, after anything was added. GEOLOC_OK: `outcome` is a frame's. `wait`: geoloc_wait. */
geoloc_status geoloc_process_next(geoloc_geolocator *geolocator, int32_t wait, geoloc_outcome *outcome);

/* No more frames and telemetry come. The flight may go on afterwards. */
geoloc_status geoloc_finish(geoloc_geolocator *geolocator);
/* The vehicle's clock began anew, or stepped against the clock that frames are stamped by. */
geoloc_status geoloc_on_vehicle_reboot(geoloc_geolocator *geolocator);
geoloc_status geoloc_on_vehicle_clock_step(geoloc_geolocator *geolocator);

/* ---- Results ---- */

/* The local frame: east, north, up from the vehicle's first position; up is the height above home. */
typedef struct geoloc_object {
  uint64_t id;
  double latitude_deg, longitude_deg;         /* WGS84 */
  double east_m, north_m;                     /* in the local frame */
  double covariance_m2[3];                    /* east-east, east-north, north-north */
  double height_above_home_m, sigma_height_m; /* where has_height */
  double velocity_in_enu_mps[2];              /* east, north, where has_velocity: of objects of moving classes */
  double velocity_covariance_m2ps2[3];
  double confidence;                        /* that it exists */
  int64_t first_seen_utc_ns, last_seen_utc_ns;
  int32_t class_id, hits; /* detections that made it */
  uint8_t is_confirmed, has_height, has_velocity;
} geoloc_object;

/* All objects, tentative and confirmed, in order of their ids: writes the first `capacity` of them, and how many there are to `count`.
 * `objects` may be NULL where `capacity` is 0. */
geoloc_status geoloc_objects(const geoloc_geolocator *geolocator, geoloc_object *objects, size_t capacity, size_t *count);

/* A detection of the frame located last that met the ground. */
typedef struct geoloc_fix {
  geoloc_detection detection;
  double latitude_deg, longitude_deg, east_m, north_m;
  double ground_from_pixel_mppx[4]; /* d(east, north) / d(u, v), row by row */
  double range_m;                   /* from the camera */
} geoloc_fix;
geoloc_status geoloc_fixes(const geoloc_geolocator *geolocator, geoloc_fix *fixes, size_t capacity, size_t *count);

/* Where the camera (right, down, forward) was at that frame, its calibration applied; up as the vehicle told its height. */
typedef struct geoloc_pose {
  double position_in_enu_m[3];
  double enu_from_camera_wxyz[4];
  double latency_s; /* the frame shows the world so long before its stamp */
} geoloc_pose;
geoloc_status geoloc_camera_pose(const geoloc_geolocator *geolocator, geoloc_pose *pose);

/* What was learnt of the constant errors, and 1-sigma of each; GEOLOC_NOTHING where the method learns none. */
typedef struct geoloc_calibration {
  double boresight_rad[3], sigma_boresight_rad[3]; /* about the camera's x, y, z */
  double latency_s, sigma_latency_s;
  double height_m, sigma_height_m;         /* the camera is so much higher than reported */
  double focal_ratio, sigma_focal_ratio;   /* the true focal length by the nominal one */
  double offset_m[2], sigma_offset_m[2];   /* the vehicle is so much east, north of where it reports to be */
  double position_lag_s, sigma_position_lag_s; /* the reported position is so much older than the attitude */
} geoloc_calibration;
geoloc_status geoloc_calibration_of(const geoloc_geolocator *geolocator, geoloc_calibration *calibration);

typedef struct geoloc_counters {
  uint64_t frames_waiting, frames; /* the former are not among the latter yet */
  uint64_t frames_by_fate[GEOLOC_FATES];
  uint64_t detections, detections_dropped, detections_at_edge; /* in located frames */
  uint64_t attitudes, positions, gimbals, focal_lengths, ranges; /* taken in */
  uint64_t duplicates, stale, invalid, out_of_range, too_far;    /* not taken in */
  uint64_t reboots, maps_void;
  uint64_t tracks_created, tracks_removed, tracks_merged, tracks_refused;
} geoloc_counters;
geoloc_status geoloc_counters_of(const geoloc_geolocator *geolocator, geoloc_counters *counters);

/* Between the local frame and WGS84; GEOLOC_NOTHING before the first position. */
geoloc_status geoloc_to_geodetic(const geoloc_geolocator *geolocator, double east_m, double north_m, double *latitude_deg,
                                 double *longitude_deg);
geoloc_status geoloc_to_local(const geoloc_geolocator *geolocator, double latitude_deg, double longitude_deg, double *east_m,
                              double *north_m);

/* NOLINTEND(readability-identifier-naming) */
#ifdef __cplusplus
}
#endif
#endif /* GEOLOC_GEOLOC_H */
