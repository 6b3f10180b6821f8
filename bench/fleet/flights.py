#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fuses the six gnss flights over the same clustered targets, seed by seed, and once more with one of them 5 m off.

    bench/fleet/flights.py BIN FOLDER [SEEDS]

BIN holds geoloc_sim, geoloc_replay and geoloc_fuse; FOLDER is for recordings and summaries, which are made anew."""
import json
import pathlib
import re
import shutil
import statistics
import subprocess
import sys

PATHS = range(1, 7)
OFF_M = 5.0
SCORE = re.compile(r"found (\d+) / (\d+), RMSE ([\d.]+) m \(relative ([\d.]+) m\), extra (\d+), merged pairs (\d+)")
NEES = re.compile(r"NEES ([\d.]+)")


def run(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=True)
    return done.stderr


def score(text):
    found, targets, rmse, relative, extra, merged = SCORE.search(text).groups()
    return {"found": int(found), "targets": int(targets), "rmse": float(rmse), "relative": float(relative),
            "extra": int(extra), "merged": int(merged)}


def fly(programs, folder, path, seed):
    """A flight's summary, as JSON, and its own score."""
    recording, summary = folder / "recording", folder / f"seed{seed}_path{path}.json"
    shutil.rmtree(recording, ignore_errors=True)
    run(programs / "geoloc_sim", "--flight", f"gnss_path{path}", "--scenario", 2, "--seed", seed, "--record", recording)
    told = run(programs / "geoloc_replay", recording, "--summary", summary, "--out", folder / "objects.geojson")
    shutil.copy(recording / "truth.geojson", folder / f"truth{seed}.geojson")
    return summary, score(told)


def moved(summary, folder):
    """The same flight, were its base station 5 m off."""
    document = json.loads(summary.read_text())
    for thing in document["objects"]:
        thing["position_in_enu_m"][0] += OFF_M
    file = folder / "moved.json"
    file.write_text(json.dumps(document))
    return file, document["flight"]


def fuse(programs, folder, summaries, truth):
    out = folder / "fused.geojson"
    told = run(programs / "geoloc_fuse", *summaries, "--truth", truth, "--out", out)
    return score(told) | {"nees": float(NEES.search(told)[1])}, json.loads(out.read_text())["flights"]


def main():
    programs, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    seeds = range(1, 1 + int(sys.argv[3] if len(sys.argv) > 3 else 20))
    folder.mkdir(parents=True, exist_ok=True)
    single, maps, named, wrongly_named, spoilt = [], [], 0, 0, []
    for seed in seeds:
        summaries = []
        for path in PATHS:
            summary, own = fly(programs, folder, path, seed)
            summaries.append(summary)
            single.append(own)
        truth = folder / f"truth{seed}.geojson"
        fused, flights = fuse(programs, folder, summaries, truth)
        maps.append(fused)
        wrongly_named += sum(flight["verdict"] == "quarantined" for flight in flights)
        victim = seed % len(summaries)
        file, name = moved(summaries[victim], folder)
        poisoned, flights = fuse(programs, folder, summaries[:victim] + summaries[victim + 1:] + [file], truth)
        quarantined = [flight["flight"] for flight in flights if flight["verdict"] == "quarantined"]
        named += quarantined == [name]
        spoilt.append(poisoned)
        print(seed, fused, "poisoned:", poisoned, "named" if quarantined == [name] else quarantined, flush=True)
    for label, rows in (("one flight", single), ("six, fused", maps), ("one of six 5 m off", spoilt)):
        rms = statistics.mean(row["rmse"] ** 2 for row in rows) ** 0.5
        relative = statistics.mean(row["relative"] ** 2 for row in rows) ** 0.5
        nees = statistics.mean(row["nees"] for row in rows) if "nees" in rows[0] else float("nan")
        print(f"{label}: RMSE {rms:.3f} m, relative {relative:.3f} m, NEES {nees:.2f}, found"
              f" {sum(row['found'] for row in rows)}/{sum(row['targets'] for row in rows)},"
              f" extra {sum(row['extra'] for row in rows)}, merged {sum(row['merged'] for row in rows)}")
    print(f"quarantined the flight that was 5 m off, and it alone: {named} of {len(seeds)};"
          f" honest flights quarantined: {wrongly_named}")


if __name__ == "__main__":
    main()
