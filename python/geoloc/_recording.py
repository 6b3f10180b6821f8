# SPDX-License-Identifier: Apache-2.0
"""Recordings, their replay and its results."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._fleet import FlightSummary
from ._results import Calibration, Score
from ._rows import OBJECT, RAW_FIX, TRAJECTORY, rows
from ._settings import settings_json, to_json


def _no_boxes() -> npt.NDArray[np.float64]:
    return np.empty((0, 4))


@dataclass
class Frame:
    """A frame of a recording, and what a detector saw in it. A frame without boxes is information, too."""

    time_us: int
    """Best estimate of the capture time: whole microseconds since the UNIX epoch, on the clock of the telemetry's stamps."""
    boxes_px: npt.ArrayLike = field(default_factory=_no_boxes)
    """Shape (N, 4): x and y of the top left corner, width and height, in pixels of the full image whose left edge is x = 0."""
    confidence: npt.ArrayLike = 1.0
    """A number, or shape (N,)."""
    class_id: npt.ArrayLike = 0
    """A number, or shape (N,)."""
    sigma_px: npt.ArrayLike = 0.0
    """1-sigma of the box's centre per axis: a number, or shape (N,); 0: not stated."""
    time_sigma_s: float = 0.0
    """1-sigma of time_us; 0: not stated."""
    time_quality: str = ""
    """How time_us was obtained (docs/video.md)."""
    mount: Mapping[str, Any] | None = None
    """The camera's mount then, as camera.json's; None: the recording's."""
    focal_px: tuple[float, float] | None = None
    """The focal length (fx, fy) then; None: the camera's."""
    telemetry_records: int | None = None
    """So many records of the telemetry had come when the frame was processed; None: the replay waits for what it needs."""

    @classmethod
    def _from_json(cls, line: bytes) -> Frame:
        value = json.loads(line)
        seen = value["detections"]
        frame = cls(time_us=value["time_us"])
        frame.boxes_px = np.array([one["box"] for one in seen], dtype=np.float64).reshape(len(seen), 4)
        frame.confidence = np.array([one["confidence"] for one in seen], dtype=np.float64)
        frame.class_id = np.array([one["class_id"] for one in seen], dtype=np.int64)
        frame.sigma_px = np.array([one.get("sigma_px", 0.0) for one in seen], dtype=np.float64)
        frame.time_sigma_s = value.get("time_sigma_s", 0.0)
        frame.time_quality = value.get("time_quality", "")
        frame.mount = value.get("mount")
        frame.focal_px = tuple(value["focal_px"]) if "focal_px" in value else None
        frame.telemetry_records = value.get("telemetry_records")
        return frame

    def _to_json(self) -> str:
        boxes = np.asarray(self.boxes_px, dtype=np.float64)
        if boxes.size == 0:
            boxes = boxes.reshape(0, 4)
        if boxes.ndim != 2 or boxes.shape[1] != 4:
            raise ValueError(f"boxes_px must have the shape (N, 4), but has {boxes.shape}")
        columns = [np.broadcast_to(np.asarray(values), (len(boxes),)).tolist()
                   for values in (self.confidence, self.class_id, self.sigma_px)]
        line: dict[str, Any] = {"time_us": int(self.time_us)}
        if self.time_sigma_s:
            line["time_sigma_s"] = self.time_sigma_s
        if self.time_quality:
            line["time_quality"] = self.time_quality
        if self.mount is not None:
            line["mount"] = self.mount
        if self.focal_px is not None:
            line["focal_px"] = list(self.focal_px)
        line["detections"] = []
        for box, confidence, class_id, sigma_px in zip(boxes.tolist(), *columns):
            seen = {"box": box, "confidence": confidence, "class_id": class_id}
            if sigma_px:
                seen["sigma_px"] = sigma_px
            line["detections"].append(seen)
        if self.telemetry_records is not None:
            line["telemetry_records"] = int(self.telemetry_records)
        return to_json(line)


@dataclass
class Recording:
    """A flight: what geoloc_app records and geoloc_replay replays (docs/formats.md). People's notes on objects and the objects' pictures
    are not part of it.

    Detections are replaced in its frames: ``frame.boxes_px, frame.confidence = my_detector(frame.time_us)``.
    """

    camera: dict[str, Any]
    """camera.json's object."""
    telemetry: bytes
    """telemetry.tlog: repeated 8-byte big-endian UNIX microseconds and one MAVLink frame."""
    frames: list[Frame]
    config: dict[str, Any] | None = None
    """The settings of the run, as config.json."""
    truth: dict[str, Any] | None = None
    """The true targets: a GeoJSON FeatureCollection of Points."""
    class_names: list[str] = field(default_factory=list)
    """By class id."""
    frames_damaged: int = 0
    """Frames that were left out since they were damaged."""
    lines_skipped: int = 0
    """Bad lines that were left out in reading."""

    @classmethod
    def read(cls, folder: str | os.PathLike[str], *, keep_going: bool = False) -> Recording:
        """Reads a recording's folder. Raises ValueError with file, line and reason where it is none; with keep_going, bad lines of its frames
        are skipped and counted."""
        files, skipped = _core.read_recording(os.fspath(folder), keep_going)
        return cls(
            camera=json.loads(files.camera_json),
            telemetry=files.telemetry,
            frames=[Frame._from_json(line) for line in files.frames_jsonl.splitlines()],
            config=None if files.config_json is None else json.loads(files.config_json),
            truth=None if files.truth_geojson is None else json.loads(files.truth_geojson),
            class_names=files.class_names,
            frames_damaged=files.frames_damaged,
            lines_skipped=skipped,
        )

    def write(self, folder: str | os.PathLike[str]) -> None:
        """Writes it to a new folder, which appears under its name when it is complete. Raises ValueError where it is no recording, and
        RuntimeError where the folder exists or cannot be written."""
        _core.write_recording(self._files(), os.fspath(folder))

    def _files(self) -> _core.Files:
        files = _core.Files()
        files.camera_json = to_json(self.camera)
        files.telemetry = bytes(self.telemetry)
        files.frames_jsonl = "".join(frame._to_json() + "\n" for frame in self.frames).encode()
        files.config_json = None if self.config is None else json.dumps(self.config, indent=2)
        files.truth_geojson = None if self.truth is None else to_json(self.truth)
        files.class_names = list(self.class_names)
        files.frames_damaged = self.frames_damaged
        return files


class Result:
    """What a replay found. `replay` makes it."""

    def __init__(self, run: _core.Run) -> None:
        self._run = run
        self.objects: npt.NDArray[np.void] = rows(run.objects(), OBJECT)
        """The confirmed objects in order of their ids: dtype `geoloc.OBJECT`, shape (N,)."""
        self.fixes: npt.NDArray[np.void] = rows(run.fixes(), RAW_FIX)
        """Every detection that met the ground, before any tracking, and the object that it was taken for: dtype `geoloc.RAW_FIX`, shape (N,)."""
        self.trajectory: npt.NDArray[np.void] = rows(run.trajectory(), TRAJECTORY)
        """Where the vehicle was at the located frames: dtype `geoloc.TRAJECTORY`, shape (N,)."""
        calibration = run.calibration()
        self.calibration: Calibration | None = None if calibration is None else Calibration(**calibration)
        """What was learnt of the constant errors; None where the method learns none."""
        self.summary: str = run.summary()
        """Lines for a person, as geoloc_replay says them."""

    def flight_summary(self, flight: str = "", *, part_of: str = "") -> FlightSummary | None:
        """All that the flight knows of its objects at rest, for `geoloc.fuse`: what geoloc_replay's --summary writes. None before the first
        located frame, and of the method "paper".

        flight: its name, up to 64 letters, digits and ``-_.:``; empty: the time and place of its start. Raises ValueError for another name.
        part_of: that of the whole flight, where the recording is a part of it; empty: parts are known by the vehicle's boot.
        """
        core = self._run.flight_summary(flight, part_of)
        return None if core is None else FlightSummary(core)

    def to_geojson(self, path: str | os.PathLike[str]) -> None:
        """Writes the file that geoloc_replay's --out writes; it appears whole or not at all. Raises RuntimeError where it cannot be written."""
        _core.write_file(os.fspath(path), self._run.geojson())

    def fixes_to_csv(self, path: str | os.PathLike[str]) -> None:
        """Writes the file that geoloc_replay's --raw writes. Raises RuntimeError where it cannot be written."""
        _core.write_file(os.fspath(path), self._run.fixes_csv())

    def geojson(self) -> dict[str, Any]:
        """The same FeatureCollection as an object, for GeoPandas' GeoDataFrame.from_features() and the like."""
        collection: dict[str, Any] = json.loads(self._run.geojson())
        return collection


def replay(
    recording: Recording | str | os.PathLike[str], method: str | None = None, **settings: Any
) -> Result:
    """Replays a recording, or a folder that holds one, and gives what geoloc_replay gives for it, to the bit.

    The settings are the recording's own, under those given here, by the names of docs/settings.md; method is "joint", the default, or
    "paper". Runs without Python's global lock; Ctrl-C ends it.

    Raises ValueError that names every fault of the recording or of the settings.
    """
    if not isinstance(recording, Recording):
        recording = Recording.read(recording)
    if method is not None:
        settings["method"] = method
    return Result(_core.Run(recording._files(), settings_json(None, settings)))


def evaluate(
    result: Result | npt.ArrayLike, truth: Mapping[str, Any] | npt.ArrayLike | None = None
) -> Score:
    """Scores objects against true targets, as docs/formats.md defines it.

    result: a `Result`; or anybody's objects, a structured array with latitude_deg and longitude_deg, or latitudes and longitudes [deg] of
    shape (N, 2). truth: GeoJSON Points, a structured array, or shape (M, 2); None: those of the result's recording.

    Raises ValueError for what is no place on Earth, and where there is no truth.
    """
    if isinstance(result, Result):
        if truth is not None and not isinstance(truth, Mapping):
            truth = _points(_places(truth))
        score = result._run.score(None if truth is None else to_json(truth))
        if truth is None and score["targets"] == 0:
            raise ValueError("the recording has no true targets: give truth")
        return Score(**score)
    if truth is None:
        raise ValueError("truth is missing")
    return Score(**_core.score_places(_places(result), _places(truth)))


def _places(places: Mapping[str, Any] | npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Latitudes and longitudes [deg], shape (N, 2)."""
    if isinstance(places, Mapping):
        lon_lat = [feature["geometry"]["coordinates"][:2] for feature in places["features"]]
        return np.ascontiguousarray(np.array(lon_lat, dtype=np.float64).reshape(-1, 2)[:, ::-1])
    array = np.asarray(places)
    if array.dtype.names:
        array = np.stack([array["latitude_deg"], array["longitude_deg"]], axis=1)
    array = np.asarray(array, dtype=np.float64)
    if array.size == 0:
        array = array.reshape(0, 2)
    if array.ndim != 2 or array.shape[1] != 2:
        raise ValueError(f"places must have the shape (N, 2), latitude and longitude, but have {array.shape}")
    return np.ascontiguousarray(array)


def _points(places: Iterable[Iterable[float]]) -> dict[str, Any]:
    """GeoJSON of latitudes and longitudes."""
    points = [{"type": "Point", "coordinates": [float(longitude), float(latitude)]} for latitude, longitude in places]
    features = [{"type": "Feature", "properties": {"id": i}, "geometry": point} for i, point in enumerate(points)]
    return {"type": "FeatureCollection", "features": features}
