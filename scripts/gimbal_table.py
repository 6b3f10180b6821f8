#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""scripts/gimbal_table.py [BIN [WORD]]: the tables of docs/flying.md, cameras on gimbals and cameras that zoom beside rigid ones
on the same flights. With WORD, only the rows whose name holds it, and those that they are compared with.

Each row is the mean over three of the flights in data/flights, with three sets of targets and errors each.
"""
import csv
import json
import math
import pathlib
import sys
import tempfile

from recorded_flights import BUILT, mean_rmse_m, replay, simulate

BIN = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else BUILT
WORD = sys.argv[2] if len(sys.argv) > 2 else ""
FLIGHTS = "stock_path1", "stock_path3", "stock_path5"
SEEDS = 1, 2, 3

# What the row is called, geoloc_sim's options, and the rows whose mean it is to be compared with.
ROWS = [
    ("rigid, looks down", (), ()),
    ("gimbal, looks down", ("--gimbal", "nadir"), ("rigid, looks down",)),
    ("rigid, 45° down in flight", ("--mount-pitch-deg", "-38"), ()),
    ("gimbal, 45° down", ("--gimbal", "45"), ("rigid, 45° down in flight",)),
    ("a perfect mount, sweeps between 90° and 40° down", ("--gimbal", "sweep", "--gimbal-perfect"), ()),
    ("gimbal, sweeps between 90° and 40° down", ("--gimbal", "sweep"), ("a perfect mount, sweeps between 90° and 40° down",)),
    ("gimbal, looks down, tells its set-point", ("--gimbal", "nadir", "--gimbal-setpoint-feedback"), ()),
    ("gimbal, 45° down, tells its set-point", ("--gimbal", "45", "--gimbal-setpoint-feedback"), ()),
] + [
    (f"gimbal, 45° down, {yaw}s, says {says}, wrongly",
     ("--gimbal", "45", "--gimbal-yaw", yaw, "--gimbal-told-yaw", told, "--gimbal-wrong-flag"), ())
    for yaw in ("follow", "lock") for told, says in (("nose", "north"), ("north", "nose"))
] + [
    ("rigid, looks down, zooms 1-4x", ("--zoom", "1..4"), ("rigid, looks down",)),
    ("rigid, 45° down in flight, zooms 1-4x", ("--mount-pitch-deg", "-38", "--zoom", "1..4"), ("rigid, 45° down in flight",)),
    ("gimbal, looks down, zooms 1-4x", ("--gimbal", "nadir", "--zoom", "1..4"), ("gimbal, looks down",)),
    ("gimbal, 45° down, zooms 1-4x", ("--gimbal", "45", "--zoom", "1..4"), ("gimbal, 45° down",)),
]
NOTICES = "contradicts that", "no noise while the vehicle shakes"


def never_shown(truth, raw):
    """How many targets have no detection within 1.5 m: a camera that zooms in flies past some of them."""
    with open(raw, newline="") as file:
        seen = [(float(row["longitude_deg"]), float(row["latitude_deg"])) for row in csv.DictReader(file)]
    targets = [feature["geometry"]["coordinates"][:2] for feature in json.loads(truth.read_text())["features"]]

    def distance_m(a, b):
        return 111.2e3 * math.hypot((a[0] - b[0]) * math.cos(math.radians(a[1])), a[1] - b[1])

    return sum(all(distance_m(target, place) > 1.5 for place in seen) for target in targets)


def score(flight, seed, options):
    """The score of a recording that geoloc_sim makes, and how many targets its camera never showed."""
    with tempfile.TemporaryDirectory(prefix="geoloc-gimbal-") as folder:
        recording, raw = pathlib.Path(folder) / "recording", pathlib.Path(folder) / "raw.csv"
        simulate(BIN, recording, "--flight", flight, "--seed", seed, *options)
        return replay(BIN, recording, "--raw", raw), never_shown(recording / "truth.geojson", raw)


def main():
    rmse_m = {}
    wanted = {name for row in ROWS if WORD in row[0] for name in (row[0], *row[2])}
    print("| camera | RMSE m | against | found | never shown | extra | noticed |\n|---|---|---|---|---|---|---|")
    for name, options, rigid in (row for row in ROWS if row[0] in wanted):
        runs = [score(flight, seed, options) for flight in FLIGHTS for seed in SEEDS]
        scores = [scored for scored, _ in runs]
        noticed = sum(any(notice in scored.said for notice in NOTICES) for scored in scores)
        rmse_m[name] = mean_rmse_m(scores)
        ratio = f"{rmse_m[name] * len(rigid) / sum(rmse_m[other] for other in rigid):.2f}" if rigid else ""
        print(f"| {name} | {rmse_m[name]:.3f} | {ratio} | {sum(s.found for s in scores)}/{sum(s.targets for s in scores)} "
              f"| {sum(unseen for _, unseen in runs)} | {sum(s.extra for s in scores)} | {noticed} of {len(scores)} |", flush=True)


if __name__ == "__main__":
    main()
