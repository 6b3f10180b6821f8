#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Divides flights into parts, replays each by itself, fuses them, and holds the map against that of the whole flight.

    bench/fleet/parts.py BIN FOLDER [SEEDS] [PARTS]

BIN holds geoloc_sim, geoloc_replay and geoloc_fuse; FOLDER is for recordings and summaries, which are made anew."""
import json
import math
import pathlib
import re
import shutil
import statistics
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tests" / "apps"))
from split_recording import split_recording  # noqa: E402

PATHS = range(1, 7)
SCORE = re.compile(r"found (\d+) / (\d+), RMSE ([\d.]+) m \(relative ([\d.]+) m\), extra (\d+), merged pairs (\d+), NEES ([\d.]+)")


def run(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=True)
    return done.stderr


def fuse(programs, folder, summaries, truth):
    """Score by the truth, objects, and flights."""
    out = folder / "fused.geojson"
    told = run(programs / "geoloc_fuse", *summaries, "--truth", truth, "--out", out)
    document = json.loads(out.read_text())
    return [float(number) for number in SCORE.search(told).groups()], document["features"], document["flights"]


def place(feature):
    longitude, latitude = feature["geometry"]["coordinates"][:2]
    return longitude * 111320.0 * math.cos(math.radians(latitude)), latitude * 110574.0


def off(feature, other):
    return math.dist(place(feature), place(other))


def sigma_of(feature):
    """Stated 1-sigma per axis."""
    told = feature["properties"]
    return math.sqrt(0.5 * (told["sigma_major_m"] ** 2 + told["sigma_minor_m"] ** 2))


def sigma(features):
    return statistics.mean(sigma_of(one) for one in features)


def without_part(file, folder):
    """The summary as it would be of a flight by itself."""
    document = json.loads(file.read_text())
    document["version"] = 1
    document.pop("part", None)
    plain = folder / ("plain-" + file.name)
    plain.write_text(json.dumps(document))
    return plain


def main():
    programs, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    seeds = range(1, 1 + int(sys.argv[3] if len(sys.argv) > 3 else 5))
    count = int(sys.argv[4]) if len(sys.argv) > 4 else 2
    folder.mkdir(parents=True, exist_ok=True)
    rows = {"whole": [], "parts": [], "taken for flights": [], "one part": []}
    apart_m, apart_sigmas, sigmas, joined = [], [], {name: [] for name in rows}, 0
    for seed in seeds:
        for path in PATHS:
            recording, parts = folder / "recording", [folder / f"part{i}" for i in range(count)]
            shutil.rmtree(recording, ignore_errors=True)
            run(programs / "geoloc_sim", "--flight", f"gnss_path{path}", "--scenario", 2, "--seed", seed, "--record", recording)
            split_recording(recording, parts, [(i + 1) / count for i in range(count - 1)])
            files = {}
            for one in (recording, *parts):
                files[one.name] = folder / f"{one.name}.json"
                run(programs / "geoloc_replay", one, "--summary", files[one.name], "--out", folder / "objects.geojson")
            of_parts = [files[part.name] for part in parts]
            truth = recording / "truth.geojson"
            maps = {"whole": [files["recording"]], "parts": of_parts, "one part": of_parts[:1],
                    "taken for flights": [without_part(file, folder) for file in of_parts]}
            objects = {}
            for name, summaries in maps.items():
                score, objects[name], flights = fuse(programs, folder, summaries, truth)
                rows[name].append(score)
                sigmas[name].append(sigma(objects[name]))
                joined += name == "parts" and all("parts" in flight for flight in flights)
            for one in objects["whole"]:
                nearest = min(objects["parts"], key=lambda other: off(one, other))
                apart_m.append(off(one, nearest))
                apart_sigmas.append(off(one, nearest) / sigma_of(one))
            print(seed, path, {name: rows[name][-1] for name in rows}, {name: round(sigmas[name][-1], 3) for name in rows}, flush=True)
    for name, scores in rows.items():
        rmse = statistics.mean(score[2] ** 2 for score in scores) ** 0.5
        print(f"{name}: RMSE {rmse:.3f} m, stated {statistics.mean(value ** 2 for value in sigmas[name]) ** 0.5:.3f} m per axis,"
              f" NEES {statistics.mean(score[6] for score in scores):.2f}, found {sum(score[0] for score in scores):.0f},"
              f" extra {sum(score[4] for score in scores):.0f}, merged {sum(score[5] for score in scores):.0f}")
    def rms(values):
        return math.sqrt(statistics.mean(value * value for value in values))

    print(f"joined: {joined} of {len(rows['parts'])}; parts against whole: {rms(apart_m):.3f} m RMS, {rms(apart_sigmas):.2f} sigmas,"
          f" at most {max(apart_m):.2f} m, {max(apart_sigmas):.1f} sigmas")


if __name__ == "__main__":
    main()
