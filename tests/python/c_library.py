# SPDX-License-Identifier: Apache-2.0
"""The library for C by ctypes, as an oracle: structures as include/geoloc/geoloc.h has them."""
import ctypes as c
import os


def _structure(name, **fields):
    return type(name, (c.Structure,), {"_fields_": list(fields.items())})


Attitude = _structure("Attitude", time_ns=c.c_int64, angles_rad=c.c_double * 3, rates=c.c_double * 3, has_rates=c.c_uint8)
Position = _structure("Position", time_ns=c.c_int64, latitude_deg=c.c_double, longitude_deg=c.c_double, height_above_home_m=c.c_double,
                      height_msl_m=c.c_double, sigma_horizontal_m=c.c_double, velocity=c.c_double * 3, has_height_msl=c.c_uint8,
                      has_velocity=c.c_uint8)
Detection = _structure("Detection", box_px=c.c_double * 4, confidence=c.c_double, class_id=c.c_int32, sigma_px=c.c_double)
Mount = _structure("Mount", angles_deg=c.c_double * 3, lever_m=c.c_double * 3, kind=c.c_int32)
Frame = _structure("Frame", captured_at_ns=c.c_int64, captured_at_utc_ns=c.c_int64, time_sigma_s=c.c_double,
                   detections=c.POINTER(Detection), detection_count=c.c_size_t, focal_px=c.c_double * 2, mount=Mount, has_mount=c.c_uint8)
Outcome = _structure("Outcome", captured_at_ns=c.c_int64, captured_at_utc_ns=c.c_int64, fate=c.c_int32)
Object = _structure("Object", id=c.c_uint64, latitude_deg=c.c_double, longitude_deg=c.c_double, position_in_enu_m=c.c_double * 2,
                    covariance_m2=c.c_double * 3, height_above_home_m=c.c_double, sigma_height_m=c.c_double, velocity=c.c_double * 2,
                    velocity_covariance=c.c_double * 3, confidence=c.c_double, first_seen_ns=c.c_int64, last_seen_ns=c.c_int64,
                    class_id=c.c_int32, hits=c.c_int32, is_confirmed=c.c_uint8, has_height=c.c_uint8, has_velocity=c.c_uint8)
Camera = _structure("Camera", size_px=c.c_int32 * 2, lens_px=c.c_double * 4, distortion=c.c_double * 5, mount=Mount)


class CGeolocator:
    """What geoloc.Geolocator is, through C, for a camera of that width, height and field of view."""

    def __init__(self, width_px, height_px, fov_deg, **numbers):
        self._c = c.CDLL(os.environ["GEOLOC_C_LIBRARY"])
        self._c.geoloc_config_create.restype = c.c_void_p
        self._c.geoloc_camera_from_field_of_view.restype = Camera
        self._c.geoloc_last_error.restype = c.c_char_p
        config = c.c_void_p(self._c.geoloc_config_create())
        camera = self._c.geoloc_camera_from_field_of_view(width_px, height_px, c.c_double(fov_deg))
        self._call("geoloc_config_set_camera", config, c.byref(camera))
        for path, value in numbers.items():
            self._call("geoloc_config_set_number", config, path.encode(), c.c_double(value))
        self._handle = c.c_void_p()
        self._call("geoloc_create", config, c.byref(self._handle))
        self._c.geoloc_config_destroy(config)

    def close(self):
        self._c.geoloc_destroy(self._handle)

    def _call(self, name, *arguments):
        status = getattr(self._c, name)(*arguments)
        if status < 0:
            raise ValueError(self._c.geoloc_last_error().decode())
        return status

    def add_attitude(self, time_ns, angles_rad):
        self._call("geoloc_add_attitude", self._handle, c.byref(Attitude(time_ns=time_ns, angles_rad=tuple(angles_rad))))

    def add_position(self, time_ns, latitude_deg, longitude_deg, height_m, sigma_m):
        self._call("geoloc_add_position", self._handle, c.byref(Position(
            time_ns=time_ns, latitude_deg=latitude_deg, longitude_deg=longitude_deg, height_above_home_m=height_m,
            sigma_horizontal_m=sigma_m)))

    def add_frame(self, time_ns, utc_ns, boxes_px, confidence, class_ids):
        seen = (Detection * len(boxes_px))(*[Detection(box_px=tuple(box), confidence=one, class_id=class_id)
                                             for box, one, class_id in zip(boxes_px, confidence, class_ids)])
        self._call("geoloc_add_frame", self._handle,
                   c.byref(Frame(captured_at_ns=time_ns, captured_at_utc_ns=utc_ns, detections=seen, detection_count=len(seen))), None)

    def process(self):
        """(time [ns], fate) of each frame that waits no longer."""
        outcome, outcomes = Outcome(), []
        while self._call("geoloc_process_next", self._handle, 0, c.byref(outcome)) == 0:
            outcomes.append((outcome.captured_at_ns, outcome.fate))
        return outcomes

    def finish(self):
        self._call("geoloc_finish", self._handle)

    def objects(self):
        count = c.c_size_t()
        objects = (Object * 1000)()
        self._call("geoloc_objects", self._handle, objects, c.c_size_t(1000), c.byref(count))
        return objects[:count.value]
