# SPDX-License-Identifier: Apache-2.0
"""A simulated recording and its raw fixes, in metres east and north of one origin, with the true target of each fix."""

import csv
import gzip
import json
from dataclasses import dataclass
from datetime import datetime, timezone
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation, Slerp

CLUTTER = -1
GROUND_MSL_M = 10.0  # data/flights/README.md
FARTHEST_LABEL_PX = 10.0  # 7 sigma of a simulated box's centre; the next target is 35 px away at least


@dataclass(frozen=True)
class Run:
    origin_deg: np.ndarray  # longitude, latitude
    targets: np.ndarray  # (n, 2) east, north [m]
    times: list[datetime]  # per frame
    fixes: list[np.ndarray]  # per frame: (k, 2) east, north [m]
    labels: list[np.ndarray]  # per frame: (k,) index of the true target, or CLUTTER


def to_metres(lon_lat_deg: np.ndarray, origin_deg: np.ndarray) -> np.ndarray:
    """Longitude and latitude (n, 2) as east and north [m] of an origin less than a kilometre away (WGS84)."""
    a_m, e2 = 6378137.0, 6.69437999014e-3
    sine = np.sin(np.radians(origin_deg[1]))
    prime_m = a_m / np.sqrt(1 - e2 * sine**2)
    meridian_m = prime_m * (1 - e2) / (1 - e2 * sine**2)
    scale_m = np.array([prime_m * np.sqrt(1 - sine**2), meridian_m])
    return np.radians(np.asarray(lon_lat_deg).reshape(-1, 2) - origin_deg) * scale_m


def read_points_deg(geojson: Path) -> np.ndarray:
    """Longitude, latitude (n, 2) of a FeatureCollection of Points."""
    features = json.loads(geojson.read_text())["features"]
    return np.array([feature["geometry"]["coordinates"][:2] for feature in features], dtype=float).reshape(-1, 2)


def read_run(recording: Path, raw_csv: Path, flights: Path) -> Run:
    targets_deg = read_points_deg(recording / "truth.geojson")
    origin_deg = targets_deg.mean(axis=0)
    targets = to_metres(targets_deg, origin_deg)
    stamps_us = [json.loads(line)["time_us"] for line in (recording / "frames.jsonl").read_text().splitlines()]
    rows = [[] for _ in stamps_us]
    frame_at_ms = {stamp // 1000: index for index, stamp in enumerate(stamps_us)}
    with raw_csv.open() as file:
        for row in csv.DictReader(file):
            seen_ms = round(datetime.fromisoformat(row["time"]).timestamp() * 1000)
            if seen_ms not in frame_at_ms:
                raise ValueError(f"{raw_csv}: a fix at {row['time']} belongs to no frame of {recording}/frames.jsonl")
            rows[frame_at_ms[seen_ms]].append(row)

    def columns(frame: list[dict], *names: str) -> np.ndarray:
        return np.array([[row[name] for name in names] for row in frame], dtype=float).reshape(-1, len(names))

    targets_px = project_targets(recording, flights, targets, origin_deg, len(stamps_us))
    labels = []
    for frame, expected_px in zip(rows, targets_px):
        boxes = columns(frame, "box_x", "box_y", "box_width", "box_height")
        centres_px = boxes[:, :2] + boxes[:, 2:] / 2 - 0.5
        apart_px = np.linalg.norm(centres_px[:, None] - expected_px[None], axis=2)
        labels.append(np.where(apart_px.min(axis=1) < FARTHEST_LABEL_PX, apart_px.argmin(axis=1), CLUTTER))
    return Run(
        origin_deg=origin_deg,
        targets=targets,
        times=[datetime.fromtimestamp(stamp / 1e6, timezone.utc) for stamp in stamps_us],
        fixes=[to_metres(columns(frame, "longitude_deg", "latitude_deg"), origin_deg) for frame in rows],
        labels=labels,
    )


def project_targets(
    recording: Path, flights: Path, targets: np.ndarray, origin_deg: np.ndarray, frames: int
) -> np.ndarray:
    """Where each target truly was in each image: (frames, targets, 2) [px], from the flight's truth and sim.json."""
    injected = json.loads((recording / "sim.json").read_text())
    camera = json.loads((recording / "camera.json").read_text())
    with gzip.open(flights / f"{injected['flight']}_truth.csv.gz", "rt") as file:
        truth = np.loadtxt(file, delimiter=",", skiprows=1)
    exposed_s = injected["start_s"] + np.arange(frames) / injected["frame_rate_hz"]
    at_s = truth[:, 0]
    east_north = to_metres(truth[:, [2, 1]], origin_deg)
    north, east, down = (
        np.interp(exposed_s, at_s, values)
        for values in (east_north[:, 1], east_north[:, 0], GROUND_MSL_M - truth[:, 3])
    )
    ned_from_body = Slerp(at_s, Rotation.from_euler("ZYX", truth[:, [6, 5, 4]]))(np.clip(exposed_s, at_s[0], at_s[-1]))
    error, mount = injected["mount_error_deg"], camera["mount"]
    body_from_forward = Rotation.from_matrix([[0, 0, 1], [1, 0, 0], [0, 1, 0]])  # camera: right, down, ahead
    body_from_camera = (
        Rotation.from_rotvec([error["roll"], error["pitch"], error["yaw"]], degrees=True)
        * Rotation.from_euler("ZYX", [mount["yaw_deg"], mount["pitch_deg"], mount["roll_deg"]], degrees=True)
        * body_from_forward
    )
    camera_from_ned = (ned_from_body * body_from_camera).inv().as_matrix()
    ground_ned = np.column_stack([targets[:, 1], targets[:, 0], np.zeros(len(targets))])
    rays = np.einsum("fij,ftj->fti", camera_from_ned, ground_ned[None] - np.column_stack([north, east, down])[:, None])
    pixels = rays[..., :2] / rays[..., 2:] * [camera["fx"], camera["fy"]] + [camera["cx"], camera["cy"]]
    return np.where(rays[..., 2:] > 0, pixels, np.inf)
