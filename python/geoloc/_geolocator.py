# SPDX-License-Identifier: Apache-2.0
"""The estimator for one's own detections and poses."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._results import Calibration, Fate, Outcome
from ._rows import FIX, OBJECT, rows
from ._settings import settings_json, to_json

_FARTHEST_S = 4e9


def _ns(time_s: npt.ArrayLike, name: str = "time_s") -> npt.NDArray[np.int64]:
    """Nanoseconds, shape (N,)."""
    times_s = np.atleast_1d(np.asarray(time_s, dtype=np.float64))
    if times_s.ndim != 1 or not (np.abs(times_s) <= _FARTHEST_S).all():
        raise ValueError(f"{name} must be seconds within ±{_FARTHEST_S:g}, a number or an array of shape (N,)")
    return np.ascontiguousarray(np.rint(times_s * 1e9).astype(np.int64))


def _table(values: npt.ArrayLike, columns: int, name: str) -> npt.NDArray[np.float64]:
    """Shape (N, columns)."""
    array = np.asarray(values, dtype=np.float64)
    if array.size == 0 and array.ndim < 2:
        array = array.reshape(0, columns)
    array = np.atleast_2d(array)
    if array.ndim != 2 or array.shape[1] != columns:
        raise ValueError(f"{name} must have the shape ({columns},) or (N, {columns}), but has {np.shape(values)}")
    return np.ascontiguousarray(array)


def _column(values: npt.ArrayLike, count: int, dtype: npt.DTypeLike, name: str) -> npt.NDArray[Any]:
    """Shape (count,), of one value or of as many."""
    array = np.asarray(values, dtype=dtype)
    if array.ndim > 1 or array.ndim == 1 and len(array) != count:
        raise ValueError(f"{name} must be a number or have the shape ({count},), but has {array.shape}")
    return np.ascontiguousarray(np.broadcast_to(array, (count,)))


def memory_needed(settings: Mapping[str, Any] | None = None, **more: Any) -> int:
    """What a `Geolocator` of these settings will ask of the heap when it is made [bytes], without what Python keeps about it.

    Takes none of it: to be asked before. Settings and errors are those of `Geolocator`.
    """
    return _core.memory_needed(settings_json(settings, more))


class Geolocator:
    """Telemetry and a detector's boxes in, objects on the ground out; MAVLink is not needed.

    Settings are those of docs/settings.md by the same names, nested as there: ``Geolocator(method="joint",
    joint={"max_tracks": 100}, camera={"width": 1280, "height": 720, "horizontal_fov_deg": 70})``; a mapping of them, as
    config.json holds, may be given first. ``camera`` is camera.json's object, or the name of a calibration file.

    Times are seconds on one clock, the vehicle's. Samples may come in any order and at any rate, one by one or as arrays of a whole flight:
    each waits for a frame of its time. What cannot be used is counted (`counters`). Frames of reference are docs/library.md's: the world
    is east, north, up about the vehicle's first position, the body is forward, right, down.

    The computation runs without Python's global lock; calls of several threads come one after the other.

    Raises ValueError that names every fault of the settings.
    """

    def __init__(self, settings: Mapping[str, Any] | None = None, **more: Any) -> None:
        self._estimator = _core.Estimator(settings_json(settings, more))

    def add_attitude(
        self, time_s: npt.ArrayLike, roll_pitch_yaw_rad: npt.ArrayLike, rates_in_body_radps: npt.ArrayLike | None = None
    ) -> None:
        """The body's attitude against north, east and down; yaw from true north, clockwise.

        Shapes: time_s () or (N,), roll_pitch_yaw_rad (3,) or (N, 3), and so rates_in_body_radps: about forward, right and down.
        """
        rates = None if rates_in_body_radps is None else _table(rates_in_body_radps, 3, "rates_in_body_radps")
        self._estimator.add_attitudes(_ns(time_s), _table(roll_pitch_yaw_rad, 3, "roll_pitch_yaw_rad"), rates)

    def add_position(
        self,
        time_s: npt.ArrayLike,
        latitude_deg: npt.ArrayLike,
        longitude_deg: npt.ArrayLike,
        height_above_home_m: npt.ArrayLike,
        *,
        height_msl_m: npt.ArrayLike = np.nan,
        sigma_horizontal_m: npt.ArrayLike = np.nan,
        velocity_in_enu_mps: npt.ArrayLike | None = None,
    ) -> None:
        """The vehicle's position (WGS84). NaN: not told.

        Shapes: all () or (N,); velocity_in_enu_mps, east, north and up, (3,) or (N, 3). sigma_horizontal_m is the receiver's own claim.
        """
        times_ns = _ns(time_s)
        count = len(times_ns)
        positions = np.full((count, 8), np.nan)
        columns = {
            "latitude_deg": latitude_deg,
            "longitude_deg": longitude_deg,
            "height_above_home_m": height_above_home_m,
            "height_msl_m": height_msl_m,
            "sigma_horizontal_m": sigma_horizontal_m,
        }
        for place, (name, values) in enumerate(columns.items()):
            positions[:, place] = _column(values, count, np.float64, name)
        if velocity_in_enu_mps is not None:
            positions[:, 5:] = _table(velocity_in_enu_mps, 3, "velocity_in_enu_mps")
        self._estimator.add_positions(times_ns, positions)

    def add_gimbal(
        self,
        time_s: npt.ArrayLike,
        level_from_gimbal_wxyz: npt.ArrayLike,
        *,
        yaw: str = "nose",
        holds_direction: bool | None = None,
    ) -> None:
        """How a gimbal holds its camera (``camera={"mount": {"kind": "gimbal"}, …}``), as it tells.

        Shape of level_from_gimbal_wxyz: (4,) or (N, 4), the rotation from the gimbal's axes (forward, right, down) to level ones, whose
        x points to where yaw counts from: the vehicle's "nose", or "north". holds_direction: whether it says that it holds a direction
        over ground; None: it does not say.
        """
        if yaw not in ("nose", "north"):
            raise ValueError(f'yaw must be "nose" or "north", but is {yaw!r}')
        turns = _table(level_from_gimbal_wxyz, 4, "level_from_gimbal_wxyz")
        self._estimator.add_gimbals(_ns(time_s), turns, yaw == "north", holds_direction)

    def add_range(self, time_s: npt.ArrayLike, distance_m: npt.ArrayLike) -> None:
        """What a rangefinder that looks down the body's axis measures. Shapes: () or (N,)."""
        times_ns = _ns(time_s)
        self._estimator.add_ranges(times_ns, _column(distance_m, len(times_ns), np.float64, "distance_m"))

    def add_field_of_view(
        self, time_s: npt.ArrayLike, horizontal_rad: npt.ArrayLike = np.nan, vertical_rad: npt.ArrayLike = np.nan
    ) -> None:
        """What a camera that zooms shows between the edges of its image. Shapes: () or (N,); NaN: not told."""
        times_ns = _ns(time_s)
        angles = [_column(horizontal_rad, len(times_ns), np.float64, "horizontal_rad"),
                  _column(vertical_rad, len(times_ns), np.float64, "vertical_rad")]
        self._estimator.add_fields_of_view(times_ns, np.ascontiguousarray(np.stack(angles, axis=1)))

    def process(
        self,
        time_s: float,
        boxes_px: npt.ArrayLike = (),
        confidence: npt.ArrayLike = 1.0,
        class_id: npt.ArrayLike = 0,
        sigma_px: npt.ArrayLike = 0.0,
        *,
        utc_ns: int = 0,
        time_sigma_s: float = 0.0,
        mount: Mapping[str, Any] | None = None,
        focal_px: tuple[float, float] | None = None,
    ) -> list[Outcome]:
        """Adds a frame that was captured then, the middle of its exposure, and locates all that have the telemetry around them.

        A frame waits for an attitude and a position from beyond its time. What is answered are the frames that wait no longer, often
        earlier ones. A frame without boxes is information, too: nothing was seen.

        boxes_px: shape (N, 4), x and y of the top left corner, width and height, in pixels of the full image whose left edge is x = 0.
        confidence, class_id, sigma_px (1-sigma of the box's centre per axis, 0: not stated): a number or shape (N,).
        utc_ns: the time since the UNIX epoch, for first_seen and last_seen; 0: time_s stands for it. time_sigma_s: 1-sigma of time_s;
        0: not stated. mount, as camera.json's, and focal_px, (fx, fy), are this frame's where they are not the settings'.
        """
        boxes = _table(boxes_px, 4, "boxes_px")
        count = len(boxes)
        classes = _column(class_id, count, np.int64, "class_id")
        if (np.abs(classes) > 2**31 - 1).any():
            raise ValueError("class_id is beyond 2147483647")
        return self._outcomes(
            self._estimator.process(
                int(_ns(time_s)[0]),
                int(utc_ns),
                float(time_sigma_s),
                boxes,
                _column(confidence, count, np.float64, "confidence"),
                classes,
                _column(sigma_px, count, np.float64, "sigma_px"),
                None if mount is None else to_json(mount),
                focal_px,
            )
        )

    def process_waiting(self) -> list[Outcome]:
        """Locates the frames whose telemetry has come meanwhile."""
        return self._outcomes(self._estimator.process_waiting())

    def finish(self) -> list[Outcome]:
        """No more frames and telemetry come: what waits is decided by what is known. The flight may go on afterwards."""
        return self._outcomes(self._estimator.finish())

    def on_vehicle_reboot(self) -> list[Outcome]:
        """The vehicle's clock began anew: to be called after the last sample of before."""
        return self._outcomes(self._estimator.on_vehicle_reboot())

    def objects(self, *, confirmed_only: bool = True) -> npt.NDArray[np.void]:
        """The objects in order of their ids: a structured array of dtype `geoloc.OBJECT`, shape (N,)."""
        return rows(self._estimator.objects(confirmed_only), OBJECT)

    def fixes(self) -> npt.NDArray[np.void]:
        """The detections of the frame located last that meet the ground: dtype `geoloc.FIX`, shape (N,)."""
        return rows(self._estimator.fixes(), FIX)

    def calibration(self) -> Calibration | None:
        """What was learnt of the constant errors; None where the method learns none."""
        fields = self._estimator.calibration()
        return None if fields is None else Calibration(**fields)

    def counters(self) -> dict[str, int]:
        """What came in and what became of it."""
        return self._estimator.counters()

    def enu_from_camera(self) -> npt.NDArray[np.float64] | None:
        """The camera's pose at the frame located last, its calibration applied: shape (4, 4), from the camera's right, down, forward to
        east, north, up [m]; up as the vehicle told its height above home. None before a frame was located."""
        pose = self._estimator.camera_pose()
        if pose is None:
            return None
        w, x, y, z = pose[3:]
        matrix = np.eye(4)
        matrix[:3, 3] = pose[:3]
        matrix[:3, :3] = [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
        return matrix

    def origin_deg(self) -> tuple[float, float] | None:
        """Latitude and longitude of the local frame's origin; None before the first position."""
        return self._estimator.origin()

    def to_geodetic(self, east_m: float, north_m: float) -> tuple[float, float]:
        """Latitude and longitude [deg] of a place in the local frame. Raises ValueError before the first position."""
        return self._estimator.to_geodetic(east_m, north_m)

    def to_local(self, latitude_deg: float, longitude_deg: float) -> tuple[float, float]:
        """East and north [m] of a place. Raises ValueError before the first position, and for what is no place."""
        return self._estimator.to_local(latitude_deg, longitude_deg)

    @staticmethod
    def _outcomes(pairs: list[tuple[int, int]]) -> list[Outcome]:
        return [Outcome(time_ns / 1e9, Fate(fate)) for time_ns, fate in pairs]
