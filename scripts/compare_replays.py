#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""scripts/compare_replays.py BEFORE_BIN AFTER_BIN [FOLDER]: compares the results of two builds byte for byte.

Makes recordings with AFTER_BIN/geoloc_sim in FOLDER (default: build/compare; kept, and used again), replays each with
both builds' geoloc_replay, and compares --out, --csv and --raw. Names of settings may differ between the builds: they are
taken from each build's --print-config. Some 60 recordings, 85 replays; half a minute on two cores.
"""
import concurrent.futures
import itertools
import json
import os
import pathlib
import random
import subprocess
import sys

FLIGHTS = [f"{kind}_path{number}" for kind in ("stock", "gnss") for number in range(1, 7)]
OUTPUTS = {"--out": "objects.geojson", "--csv": "objects.csv", "--raw": "raw.csv"}


def recordings():
    """{name: options of geoloc_sim}"""
    made = {}
    for flight, scenario in itertools.product(FLIGHTS, (1, 2, 3)):
        made[f"{flight}_scenario{scenario}"] = ["--flight", flight, "--scenario", scenario]
    for flight, raised_m in itertools.product(("stock_path1", "gnss_path3"), (-10, 10, 30, 60, 100)):
        made[f"{flight}_{20 + raised_m}m"] = ["--flight", flight, "--raise-m", raised_m]
    for flight, pair_m in itertools.product(("stock_path2", "gnss_path5", "stock_path6"), (0.5, 0.8)):
        made[f"{flight}_pairs_{pair_m}m"] = ["--flight", flight, "--pairs-m", pair_m, "--miss-rate", 0.2,
                                             "--target-size-m", 0.7 * pair_m]
    for flight in ("stock_path4", "gnss_path1"):
        made[f"{flight}_poor_detector"] = ["--flight", flight, "--scenario", 2, "--miss-rate", 0.35, "--clutter-rate", 1.5,
                                           "--pixel-noise", 3]
        made[f"{flight}_tilted"] = ["--flight", flight, "--mount-pitch-deg", -60, "--seed", 5]
        made[f"{flight}_fast_frames"] = ["--flight", flight, "--frame-rate", 25, "--seed", 6]
    return made


def add_moving_class(recording, moving):
    """A copy in which every other detection is of class 1, plus a box that crosses the image."""
    moving.mkdir()
    for file in recording.iterdir():
        if file.name != "frames.jsonl":
            (moving / file.name).write_bytes(file.read_bytes())
    draw = random.Random(1)
    with open(moving / "frames.jsonl", "w") as frames:
        for number, line in enumerate(open(recording / "frames.jsonl")):
            frame = json.loads(line)
            for detection in frame.get("detections", [])[1::2]:
                detection["class_id"] = 1
            if number % 60 < 50 and draw.random() < 0.9:
                x = 100 + 18 * (number % 60) + draw.gauss(0, 1.5)
                frame["detections"].append({"box": [x, 300 + draw.gauss(0, 1.5), 30, 30], "confidence": 0.9, "class_id": 1})
            frames.write(json.dumps(frame) + "\n")


def run(*command):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}:\n{done.stderr[-2000:]}")
    return done.stdout


class Build:
    def __init__(self, label, binaries):
        self.label, self.replay = label, binaries / "geoloc_replay"
        self.joint = "joint" if "joint" in json.loads(run(self.replay, "--print-config")) else "full"

    def arguments(self, variant, recording, scratch):
        """The options of a variant, with this build's names."""
        if variant == "paper":
            return ["--method", "paper"]
        if variant == "moving":
            config = scratch / "moving.json"
            config.write_text(json.dumps({self.joint: {"moving": {"classes": [1]}}}))
            return ["--config", config]
        if variant == "known":
            truth = json.loads((recording / "truth.geojson").read_text())
            truth["features"] = truth["features"][:2]
            known = scratch / "known.geojson"
            known.write_text(json.dumps(truth))
            return ["--reference", known]
        return []

    def results(self, variant, recording, folder):
        scratch = folder / f"{recording.name}-{variant}" / self.label
        scratch.mkdir(parents=True, exist_ok=True)
        outputs = [part for option, name in OUTPUTS.items() for part in (option, scratch / name)]
        run(self.replay, recording, *self.arguments(variant, recording, scratch), *outputs)
        return scratch


def content(file):
    """The joint method was once called full, known points references."""
    return (file.read_bytes().replace(b'"method": "full"', b'"method": "joint"')
            .replace(b'"references": [', b'"known_points": ['))


def main(before, after, folder):
    folder.mkdir(parents=True, exist_ok=True)
    builds = [Build("before", before), Build("after", after)]
    cases = []
    for name, options in recordings().items():
        recording = folder / name
        if not recording.exists():
            run(after / "geoloc_sim", "--record", recording, *options)
        cases.append(("joint", recording))
        if name.endswith("scenario2"):
            cases += [("paper", recording), ("known", recording)]
        if name in ("stock_path1_scenario1", "gnss_path2_scenario2", "stock_path5_scenario3"):
            moving = folder / f"{name}_moving"
            if not moving.exists():
                add_moving_class(recording, moving)
            cases.append(("moving", moving))

    def differing(case):
        first, second = (build.results(*case, folder / "results") for build in builds)
        return [f"{first / name} {second / name}" for name in OUTPUTS.values()
                if content(first / name) != content(second / name)]

    differences, done = [], 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for found in pool.map(differing, cases):
            differences += found
            done += 1
            if sys.stderr.isatty():
                print(f"\r{done} / {len(cases)}, {len(differences)} files differ ", end="", file=sys.stderr, flush=True)
    print(f"{len(cases)} replays of {len({recording for _, recording in cases})} recordings: {len(differences)} files differ")
    print(*differences[:20], sep="\n")
    return 1 if differences else 0


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    sys.exit(main(*map(pathlib.Path, sys.argv[1:3]), pathlib.Path(sys.argv[3] if len(sys.argv) == 4 else "build/compare")))
