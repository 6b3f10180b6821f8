#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""scripts/gimbal_table.py [BIN]: the table of docs/flying.md, cameras on gimbals beside rigid ones on the same flights.

Each row is the mean over three of the flights in data/flights, with three sets of targets and errors each.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
BIN = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build" / "release" / "bin"
FLIGHTS = "stock_path1", "stock_path3", "stock_path5"
SEEDS = 1, 2, 3

# What the row is called, geoloc_sim's options, and the row that it is to be compared with.
ROWS = [
    ("rigid, looks down", (), None),
    ("gimbal, looks down", ("--gimbal", "nadir"), "rigid, looks down"),
    ("rigid, 45° down in flight", ("--mount-pitch-deg", "-38"), None),
    ("gimbal, 45° down", ("--gimbal", "45"), "rigid, 45° down in flight"),
    ("rigid, 65° down in flight", ("--mount-pitch-deg", "-58"), None),
    ("gimbal, sweeps between 90° and 40° down", ("--gimbal", "sweep"), "rigid, 65° down in flight"),
    ("gimbal, looks down, tells its set-point", ("--gimbal", "nadir", "--gimbal-setpoint-feedback"), None),
    ("gimbal, 45° down, tells its set-point", ("--gimbal", "45", "--gimbal-setpoint-feedback"), None),
] + [
    (f"gimbal, 45° down, {yaw}s, says {says}, wrongly",
     ("--gimbal", "45", "--gimbal-yaw", yaw, "--gimbal-told-yaw", told, "--gimbal-wrong-flag"), None)
    for yaw in ("follow", "lock") for told, says in (("nose", "north"), ("north", "nose"))
]
NOTICES = "contradicts that", "no noise while the vehicle shakes"


def score(flight, seed, options):
    """What geoloc_replay says of a recording that geoloc_sim makes."""
    with tempfile.TemporaryDirectory(prefix="geoloc-gimbal-") as folder:
        recording = pathlib.Path(folder) / "recording"
        subprocess.run([BIN / "geoloc_sim", "--record", recording, "--flight", flight, "--seed", str(seed), *options],
                       check=True, capture_output=True)
        replay = [BIN / "geoloc_replay", recording, "--out", pathlib.Path(folder) / "objects.geojson"]
        return subprocess.run(replay, check=True, capture_output=True, text=True).stderr


def main():
    rmse_m = {}
    print("| camera | RMSE m | against rigid | found | extra | noticed |\n|---|---|---|---|---|---|")
    for name, options, rigid in ROWS:
        said = [score(flight, seed, options) for flight in FLIGHTS for seed in SEEDS]
        errors = [float(re.search(r"RMSE ([\d.]+)", text)[1]) for text in said]
        found = [re.search(r"found (\d+) / (\d+)", text) for text in said]
        extra = sum(int(re.search(r"extra (\d+)", text)[1]) for text in said)
        noticed = sum(any(notice in text for notice in NOTICES) for text in said)
        rmse_m[name] = sum(errors) / len(errors)
        ratio = f"{rmse_m[name] / rmse_m[rigid]:.2f}" if rigid else ""
        print(f"| {name} | {rmse_m[name]:.3f} | {ratio} | {sum(int(f[1]) for f in found)}/{sum(int(f[2]) for f in found)} "
              f"| {extra} | {noticed} of {len(said)} |", flush=True)


if __name__ == "__main__":
    main()
